//! The energy that a wall patch has gathered, as it is sent to the environment behind it.

use radiosity::{Hemisphere, Mask, Rgb, Side};

use crate::problem::{Problem, Source};

/// The energy of a wall patch, for the environment behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct WallPatch {
    /// The local environment that it is for.
    pub environment: u32,
    /// The side of that environment by which light enters, by [`Side::index`].
    pub side: u8,
    /// The wall patch of that side.
    pub patch: u32,
    /// Power in each bin of directions, W, in single precision.
    pub power: Vec<[f32; 3]>,
}

impl WallPatch {
    /// Words of 8 bytes that its bins take.
    pub(crate) fn words(&self) -> u64 {
        (self.power.len() as u64 * 12).div_ceil(8)
    }

    /// The sources that it is for its environment: each bin that holds power.
    pub(crate) fn sources(&self, problem: &Problem) -> Vec<Source> {
        let environment = self.environment;
        let Some(walls) = &problem.walls else { return Vec::new() };
        let (around, side) = (problem.bounds(environment), Side::ALL[usize::from(self.side)]);
        let held = (0u32..).zip(&self.power).filter(|(_, power)| **power != [0.0; 3]);
        let source = |(bin, power): (u32, &[f32; 3])| {
            let power = Rgb::from_array(power.map(f64::from));
            let emitter = walls.emitter(&around, side, [self.patch, bin], power);
            let mask = Mask::all(walls.rays_of(&emitter).map_or(0, Hemisphere::pixels));
            Source { environment, shot: 0, emitter, mask, form_factor: 1.0 }
        };
        held.map(source).collect()
    }
}
