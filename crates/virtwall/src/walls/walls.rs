//! The virtual walls of a compute node.

use std::collections::BTreeMap;

use radiosity::{Rgb, Shot};

use super::gathered::Gathered;
use super::wall_patch::WallPatch;
use crate::problem::{Problem, Source};

/// What the virtual walls of a compute node have gathered, by environment.
#[derive(Default)]
pub(crate) struct Walls(BTreeMap<u32, Gathered>);

impl Walls {
    /// Gather the part of a source that leaves its environment; returns its number of pixels.
    pub fn gather(&mut self, problem: &Problem, source: &Source, shot: &Shot) -> u64 {
        self.0.entry(source.environment).or_default().gather(problem, source, shot)
    }

    /// Take the energy of the wall patches that are `worth` handing on, by their power and that of their
    /// brightest bin, W, and by their area, m².
    pub fn take(
        &mut self,
        problem: &Problem,
        worth: impl Fn([Rgb; 2], f64) -> bool,
    ) -> Vec<WallPatch> {
        let walls = self.0.iter_mut();
        walls.flat_map(|(&number, gathered)| gathered.take(problem, number, &worth)).collect()
    }

    /// The number of wall patches that have gathered anything.
    pub fn patches(&self) -> u64 {
        self.0.values().map(Gathered::patches).sum()
    }

    /// Power that was gathered and not handed on, W.
    pub fn power(&self) -> Rgb {
        self.0.values().map(Gathered::power).sum()
    }
}
