//! The energy that the virtual walls of an environment have gathered and not sent yet.

use std::collections::BTreeMap;

use radiosity::{Rgb, Shot, Side};

use super::wall_patch::WallPatch;
use crate::problem::{Problem, Source};

/// Power that leaves one environment, gathered by its wall patches.
#[derive(Default)]
pub(super) struct Gathered(BTreeMap<WallPatchNumber, Held>);

/// The side by which light leaves, by [`Side::index`], and the wall patch of that side.
type WallPatchNumber = (usize, u32);

/// The power on a wall patch, W.
struct Held {
    /// By bin.
    power: Vec<Rgb>,
    sum: Rgb,
}

impl Gathered {
    /// Gather the part of a source that leaves the environment; returns its number of pixels.
    pub fn gather(&mut self, problem: &Problem, source: &Source, shot: &Shot) -> u64 {
        let Some(walls) = &problem.walls else { return 0 };
        let emitter = &source.emitter;
        let around = problem.bounds(source.environment);
        let mut pixels = 0;
        for (side, outgoing) in Side::ALL.into_iter().zip(&shot.outgoing) {
            let Some(outgoing) = outgoing else { continue };
            let rays = problem.rays_of(emitter, &source.mask);
            walls.gather(&around, side, emitter, rays, &outgoing.mask, |[patch, bin], weight| {
                let nothing =
                    || Held { power: vec![Rgb::ZERO; walls.bins() as usize], sum: Rgb::ZERO };
                let held = self.0.entry((side.index(), patch)).or_insert_with(nothing);
                held.power[bin as usize] += emitter.power * weight;
                held.sum += emitter.power * weight;
                pixels += 1;
            });
        }
        pixels
    }

    /// Power on all wall patches, W.
    pub fn power(&self) -> Rgb {
        self.0.values().map(|held| held.sum).sum()
    }

    /// The number of wall patches that have gathered anything.
    pub fn patches(&self) -> u64 {
        self.0.len() as u64
    }

    /// Take the energy of the wall patches of `environment` that are `worth` handing on, by power, W, and
    /// radiosity, W/m². It is sent in single precision; the rounding error stays here.
    pub fn take(
        &mut self,
        problem: &Problem,
        environment: u32,
        worth: impl Fn(Rgb, Rgb) -> bool,
    ) -> Vec<WallPatch> {
        let Some(walls) = &problem.walls else { return Vec::new() };
        let around = problem.bounds(environment);
        let mut handed = Vec::new();
        for (&(side, patch), held) in &mut self.0 {
            let side = Side::ALL[side];
            if worth(held.sum, held.sum / walls.area(&around, side)) {
                let power: Vec<[f32; 3]> = held.power.iter_mut().map(take_single).collect();
                held.sum = held.power.iter().sum();
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
