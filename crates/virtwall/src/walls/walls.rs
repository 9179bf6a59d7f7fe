//! The virtual walls of a compute node, and the energy that they have gathered and not sent yet.

use std::collections::BTreeMap;

use radiosity::{Rgb, Shot, Side};

use super::wall_patch::WallPatch;
use crate::problem::{Problem, Source};

/// Power that leaves the environments of a compute node, gathered by their wall patches: by environment, the
/// side by which light leaves ([`Side::index`]), and the wall patch of that side.
#[derive(Default)]
pub(crate) struct Walls(BTreeMap<(u32, usize, u32), Held>);

/// The power on a wall patch, W.
struct Held {
    /// By bin.
    power: Vec<Rgb>,
    sum: Rgb,
    /// The power of the brightest bin.
    brightest: Rgb,
}

impl Held {
    fn new(bins: u32) -> Held {
        Held { power: vec![Rgb::ZERO; bins as usize], sum: Rgb::ZERO, brightest: Rgb::ZERO }
    }

    fn add(&mut self, bin: u32, power: Rgb) {
        let held = &mut self.power[bin as usize];
        *held += power;
        self.sum += power;
        self.brightest = brighter(self.brightest, *held);
    }

    /// Take the power that single precision can hold.
    fn take(&mut self) -> Vec<[f32; 3]> {
        let taken = self.power.iter_mut().map(take_single).collect();
        self.sum = self.power.iter().sum();
        self.brightest = self.power.iter().copied().fold(Rgb::ZERO, brighter);
        taken
    }
}

fn brighter(one: Rgb, other: Rgb) -> Rgb {
    if other.element_sum() > one.element_sum() { other } else { one }
}

impl Walls {
    /// Gather the part of a source that leaves its environment; returns its number of pixels.
    pub fn gather(&mut self, problem: &Problem, source: &Source, shot: &Shot) -> u64 {
        let Some(walls) = &problem.walls else { return 0 };
        let emitter = &source.emitter;
        let around = problem.bounds(source.environment);
        let mut pixels = 0;
        for (side, outgoing) in Side::ALL.into_iter().zip(&shot.outgoing) {
            let Some(outgoing) = outgoing else { continue };
            let rays = problem.rays_of(emitter, &source.mask);
            walls.gather(&around, side, emitter, rays, &outgoing.mask, |[patch, bin], weight| {
                let held = self.0.entry((source.environment, side.index(), patch));
                let held = held.or_insert_with(|| Held::new(walls.bins()));
                held.add(bin, emitter.power * weight);
                pixels += 1;
            });
        }
        pixels
    }

    /// Power that was gathered and not handed on, W.
    pub fn power(&self) -> Rgb {
        self.0.values().map(|held| held.sum).sum()
    }

    /// The number of wall patches that have gathered anything.
    pub fn patches(&self) -> u64 {
        self.0.len() as u64
    }

    /// Take the energy of the wall patches that are `worth` handing on, by their power and that of their
    /// brightest bin, W, and by their area, m². It is sent in single precision; the rounding error stays here.
    pub fn take(
        &mut self,
        problem: &Problem,
        worth: impl Fn([Rgb; 2], f64) -> bool,
    ) -> Vec<WallPatch> {
        let Some(walls) = &problem.walls else { return Vec::new() };
        let mut handed = Vec::new();
        for (&(environment, side, patch), held) in &mut self.0 {
            let (around, side) = (problem.bounds(environment), Side::ALL[side]);
            if worth([held.sum, held.brightest], walls.area(&around, side)) {
                let power = held.take();
                let environment = problem.decomposition.neighbour(environment, side);
                let entered_by = Side { upper: !side.upper, ..side }.index() as u8;
                handed.push(WallPatch { environment, side: entered_by, patch, power });
            }
        }
        handed
    }
}

/// Take the part of a power that single precision can hold.
fn take_single(power: &mut Rgb) -> [f32; 3] {
    let taken = power.to_array().map(|x| {
        let nearest = x as f32;
        if f64::from(nearest) > x { nearest.next_down() } else { nearest }
    });
    *power -= Rgb::from_array(taken.map(f64::from));
    taken
}
