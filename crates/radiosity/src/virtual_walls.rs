//! Virtual walls, the method before masks (§3 and reference [1] of RR-3008): interfaces are meshed,
//! and the energy that reaches them is gathered by wall patch and by direction.

use glam::DVec3;
use thiserror::Error;

use crate::geometry::Bounds;
use crate::mesh::Side;
use crate::scene::Rgb;
use crate::shoot::{Emitter, Hemisphere, Mask, unlifted};

/// The mesh of all virtual walls, and the bins of directions of their wall patches.
///
/// Choice C40: RR-3008 only says that reference [1] needs "several information such as the spatial
/// distribution of the energy" on wall patches. Here each interface has p × q equal wall patches.
/// Their cosine-weighted directions form d × d bins of equal form factor (the concentric map of a
/// square, which keeps bins compact). Of gathered energy only the wall patch and the bin are known.
/// It leaves from the centre of the wall patch, evenly over the bin, by rays of equal weight.
#[derive(Clone, Debug)]
pub struct VirtualWalls {
    /// Number of wall patches along the two axes of an interface, in the order x, y, z.
    patches: [u32; 2],
    /// Number of bins along each side of the square of directions.
    directions: u32,
    /// The rays of each bin, as a hemisphere with only these directions.
    bins: Vec<Hemisphere>,
}

/// An impossible mesh of virtual walls.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum VirtualWallsError {
    /// No wall patches, or too many.
    #[error("{0} x {1} wall patches; expected 1 to {MOST_PATCHES} each")]
    Patches(u32, u32),
    /// No bins, or too many.
    #[error("{0} x {0} directions; expected 1 to {MOST_DIRECTIONS}")]
    Directions(u32),
    /// Bins without rays, or too many rays.
    #[error(
        "{0} rays for {1} bins of directions; expected at least one each, at most {MOST_RAYS} in all"
    )]
    Rays(u32, u32),
}

const MOST_PATCHES: u32 = 256;
const MOST_DIRECTIONS: u32 = 64;
const MOST_RAYS: u32 = 1 << 24;

/// The environment index of emitters on virtual walls.
const OF_A_WALL: u32 = u32::MAX;

impl Emitter {
    /// Whether it is a bin of a wall patch instead of a patch.
    pub fn is_of_a_wall(&self) -> bool {
        self.environment == OF_A_WALL
    }
}

impl VirtualWalls {
    /// Virtual walls with `patches` wall patches of `directions` × `directions` bins each. A wall
    /// patch emits about `rays` rays: each bin has an equal square number of them.
    ///
    /// # Errors
    /// Numbers out of range.
    pub fn new(
        patches: [u32; 2],
        directions: u32,
        rays: u32,
    ) -> Result<VirtualWalls, VirtualWallsError> {
        let [p, q] = patches;
        if patches.iter().any(|n| !(1..=MOST_PATCHES).contains(n)) {
            return Err(VirtualWallsError::Patches(p, q));
        }
        if !(1..=MOST_DIRECTIONS).contains(&directions) {
            return Err(VirtualWallsError::Directions(directions));
        }
        let bins = directions * directions;
        if !(bins..=MOST_RAYS).contains(&rays) {
            return Err(VirtualWallsError::Rays(rays, bins));
        }
        let side = (f64::from(rays / bins).sqrt().round() as u32).max(1);
        let bin = |bin| Hemisphere::bin_of_square(directions, bin, side);
        Ok(VirtualWalls { patches, directions, bins: (0..bins).map(bin).collect() })
    }

    /// Number of wall patches of an interface.
    pub fn patches(&self) -> u32 {
        self.patches[0] * self.patches[1]
    }

    /// Number of bins of a wall patch.
    pub fn bins(&self) -> u32 {
        self.bins.len() as u32
    }

    /// Area of a wall patch on a side of an environment with bounds `around`, m².
    pub fn area(&self, around: &Bounds, side: Side) -> f64 {
        around.size()[u(side)] * around.size()[v(side)] / f64::from(self.patches())
    }

    /// The rays of an emitter that is a bin of a wall patch, otherwise `None`.
    pub fn rays_of(&self, emitter: &Emitter) -> Option<&Hemisphere> {
        let bin = emitter.patch as usize % self.bins.len();
        emitter.is_of_a_wall().then(|| &self.bins[bin])
    }

    /// A bin of a wall patch as an emitter into the environment `around`, through `side`.
    pub fn emitter(
        &self,
        around: &Bounds,
        side: Side,
        [patch, bin]: [u32; 2],
        power: Rgb,
    ) -> Emitter {
        let [i, j] = [patch % self.patches[0], patch / self.patches[0]];
        let mut centre = if side.upper { around.max } else { around.min };
        for (axis, place, n) in [(u(side), i, self.patches[0]), (v(side), j, self.patches[1])] {
            let share = (f64::from(place) + 0.5) / f64::from(n);
            centre[axis] = around.min[axis] + around.size()[axis] * share;
        }
        let wall_patch = side.index() as u32 * self.patches() + patch;
        Emitter {
            environment: OF_A_WALL,
            patch: wall_patch * self.bins() + bin,
            polygon: u32::MAX,
            centre,
            normal: -outwards(side),
            power,
            radiosity: power / self.area(around, side),
        }
    }

    /// Gathers the light of `mask` that leaves an environment with bounds `around` through `side`:
    /// calls `add` with wall patch and bin, and the form factor, of every pixel.
    pub fn gather(
        &self,
        around: &Bounds,
        side: Side,
        emitter: &Emitter,
        hemisphere: &Hemisphere,
        mask: &Mask,
        mut add: impl FnMut([u32; 2], f64),
    ) {
        let frame = hemisphere.frame(emitter.centre, emitter.normal);
        let plane = if side.upper { around.max } else { around.min }[side.axis];
        for pixel in mask.ones() {
            let direction = hemisphere.direction(frame, pixel);
            // Rays inside the plane of the wall cross it at their origin.
            let distance = (plane - emitter.centre[side.axis]) / direction[side.axis];
            let distance = if distance.is_finite() { distance } else { 0.0 };
            let patch = self.patch_at(around, side, emitter.centre + direction * distance);
            let left = hemisphere.weights[pixel as usize] * mask.transmittance(pixel);
            add([patch, self.bin_of(side, direction)], left);
        }
    }

    /// The wall patch that contains a point.
    fn patch_at(&self, around: &Bounds, side: Side, point: DVec3) -> u32 {
        let place = |axis: usize, n: u32| {
            let share = (point[axis] - around.min[axis]) / around.size()[axis];
            ((share * f64::from(n)).max(0.0) as u32).min(n - 1)
        };
        place(v(side), self.patches[1]) * self.patches[0] + place(u(side), self.patches[0])
    }

    /// The bin of a direction that leaves through a side.
    fn bin_of(&self, side: Side, direction: DVec3) -> u32 {
        let [tangent, bitangent, _] = self.bins[0].frame(DVec3::ZERO, outwards(side));
        let square = unlifted(direction.dot(tangent), direction.dot(bitangent));
        let n = f64::from(self.directions);
        let place = |x: f64| (((x + 1.0) * 0.5 * n).max(0.0) as u32).min(self.directions - 1);
        place(square[1]) * self.directions + place(square[0])
    }
}

/// The outward normal of a side.
fn outwards(side: Side) -> DVec3 {
    let mut normal = DVec3::ZERO;
    normal[side.axis] = if side.upper { 1.0 } else { -1.0 };
    normal
}

/// The first axis along a side, in the order x, y, z.
fn u(side: Side) -> usize {
    usize::from(side.axis == 0)
}

/// The second axis along a side.
fn v(side: Side) -> usize {
    if side.axis == 2 { 1 } else { 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AROUND: Bounds =
        Bounds { min: DVec3::new(-1.0, 0.5, 2.0), max: DVec3::new(1.0, 2.0, 5.0) };

    /// Light emitted by a bin of a wall patch and sent back through its own wall is gathered in the
    /// same wall patch and bin, so a wall changes neither energy nor its distribution.
    #[test]
    fn a_wall_patch_gathers_what_it_emits() {
        let walls = VirtualWalls::new([3, 5], 6, 900).unwrap();
        for side in Side::ALL {
            let other = Side { upper: !side.upper, ..side };
            for patch in 0..walls.patches() {
                for bin in 0..walls.bins() {
                    let emitter = walls.emitter(&AROUND, side, [patch, bin], Rgb::ONE);
                    let rays = walls.rays_of(&emitter).unwrap();
                    // Back through the same plane: the opposite side of the neighbour.
                    let (mut sum, all) = (0.0, Mask::all(rays.pixels()));
                    let Bounds { mut min, mut max } = AROUND;
                    if side.upper {
                        min[side.axis] = AROUND.max[side.axis];
                        max[side.axis] += 7.0;
                    } else {
                        max[side.axis] = AROUND.min[side.axis];
                        min[side.axis] -= 7.0;
                    }
                    let behind = Bounds { min, max };
                    walls.gather(&behind, other, &emitter, rays, &all, |place, weight| {
                        assert_eq!(place, [patch, bin]);
                        sum += weight;
                    });
                    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
                }
            }
        }
    }

    /// Bins have equal form factors: the directions of any hemisphere are spread equally over them.
    #[test]
    fn bins_share_the_hemisphere_equally() {
        use crate::shoot::HemisphereKind::Fibonacci;
        let walls = VirtualWalls::new([1, 1], 4, 16).unwrap();
        let hemisphere = Hemisphere::new(Fibonacci, 30_976, true).unwrap();
        let side = Side { axis: 1, upper: true };
        let emitter = Emitter {
            environment: 0,
            patch: 0,
            polygon: 0,
            centre: DVec3::new(0.1, 1.0, 3.0),
            normal: DVec3::Y,
            power: Rgb::ONE,
            radiosity: Rgb::ONE,
        };
        let mut shares = [0.0; 16];
        let all = Mask::all(hemisphere.pixels());
        walls.gather(&AROUND, side, &emitter, &hemisphere, &all, |[_, bin], weight| {
            shares[bin as usize] += weight;
        });
        assert!(shares.iter().all(|share| (share * 16.0 - 1.0).abs() < 0.02), "{shares:?}");
    }

    #[test]
    fn impossible_meshes_are_refused() {
        let error = |patches, directions, rays| {
            VirtualWalls::new(patches, directions, rays).unwrap_err().to_string()
        };
        assert!(error([0, 3], 2, 100).contains("0 x 3 wall patches; expected 1 to 256"));
        assert!(error([1, 1], 65, 10_000).contains("65 x 65 directions; expected 1 to 64"));
        assert!(error([1, 1], 8, 63).contains("63 rays for 64 bins"));
    }
}
