//! Virtual walls, which masks came after (§3, reference [1] of RR-3008): the bounded interface between two
//! environments is meshed, and energy that reaches it is gathered by wall patch and by direction.

use glam::DVec3;
use thiserror::Error;

use crate::geometry::Bounds;
use crate::mesh::Side;
use crate::scene::Rgb;
use crate::shoot::{Emitter, Hemisphere, Mask, unlifted};

/// How all virtual walls are meshed, and the directions over a wall patch.
///
/// Choice C40: reference [1] needs "several information such as the spatial distribution of the energy"
/// on wall patches and RR-3008 says no more of it. Here each interface has p × q equal wall patches; the
/// directions over one, weighted by the cosine, are d × d bins of equal form factor (the concentric map of
/// a square, which keeps bins compact). What is known of energy that was gathered is its wall patch and
/// its bin; it leaves from the wall patch's centre, evenly over the bin, by rays of equal weight.
#[derive(Clone, Debug)]
pub struct VirtualWalls {
    /// Wall patches along the two axes of an interface, in the order x, y, z.
    patches: [u32; 2],
    /// Bins along each side of the square of directions.
    directions: u32,
    /// The rays of each bin, as a hemisphere that has no others.
    bins: Vec<Hemisphere>,
}

/// A mesh that no virtual walls can have.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum VirtualWallsError {
    /// No wall patch, or far too many.
    #[error("{0} x {1} wall patches; expected 1 to {MOST_PATCHES} each")]
    Patches(u32, u32),
    /// No bin, or far too many.
    #[error("{0} x {0} directions; expected 1 to {MOST_DIRECTIONS}")]
    Directions(u32),
    /// Bins without a ray, or far too many.
    #[error(
        "{0} rays for {1} bins of directions; expected at least one each, at most {MOST_RAYS} in all"
    )]
    Rays(u32, u32),
}

const MOST_PATCHES: u32 = 256;
const MOST_DIRECTIONS: u32 = 64;
const MOST_RAYS: u32 = 1 << 24;

/// The environment that a source on a virtual wall says it is of.
const OF_A_WALL: u32 = u32::MAX;

impl Emitter {
    /// Whether it is a bin of a wall patch, not a patch.
    pub fn is_of_a_wall(&self) -> bool {
        self.environment == OF_A_WALL
    }
}

impl VirtualWalls {
    /// Walls of `patches` wall patches, of `directions` × `directions` bins each, that emit some `rays`
    /// rays: as near as an equal square of them a bin comes to it.
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

    /// Wall patches of an interface.
    pub fn patches(&self) -> u32 {
        self.patches[0] * self.patches[1]
    }

    /// Bins of directions of a wall patch.
    pub fn bins(&self) -> u32 {
        self.bins.len() as u32
    }

    /// Area of a wall patch on a side of the environment that lies within `around`, m².
    pub fn area(&self, around: &Bounds, side: Side) -> f64 {
        around.size()[u(side)] * around.size()[v(side)] / f64::from(self.patches())
    }

    /// The rays of a bin of a wall patch, if the source is one.
    pub fn rays_of(&self, source: &Emitter) -> Option<&Hemisphere> {
        let bin = source.patch as usize % self.bins.len();
        source.is_of_a_wall().then(|| &self.bins[bin])
    }

    /// A bin of a wall patch as a source of `power`, in the environment that lies within `around`; light
    /// enters it by `side`.
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

    /// Gather what leaves an environment, which lies within `around`, by `side`: tell the wall patch, the
    /// bin and the form factor of every pixel of `mask`.
    pub fn gather(
        &self,
        around: &Bounds,
        side: Side,
        source: &Emitter,
        hemisphere: &Hemisphere,
        mask: &Mask,
        mut told: impl FnMut([u32; 2], f64),
    ) {
        let frame = hemisphere.frame(source.centre, source.normal);
        let plane = if side.upper { around.max } else { around.min }[side.axis];
        for pixel in mask.ones() {
            let d = hemisphere.directions[pixel as usize];
            let direction = frame[0] * d.x + frame[1] * d.y + frame[2] * d.z;
            // A source in the plane of the wall has rays that run in it: these cross where they start.
            let distance = (plane - source.centre[side.axis]) / direction[side.axis];
            let distance = if distance.is_finite() { distance } else { 0.0 };
            let patch = self.patch_at(around, side, source.centre + direction * distance);
            let left = hemisphere.weights[pixel as usize] * mask.transmittance(pixel);
            told([patch, self.bin_of(side, direction)], left);
        }
    }

    /// The wall patch in which a point lies.
    fn patch_at(&self, around: &Bounds, side: Side, point: DVec3) -> u32 {
        let place = |axis: usize, n: u32| {
            let share = (point[axis] - around.min[axis]) / around.size()[axis];
            ((share * f64::from(n)).max(0.0) as u32).min(n - 1)
        };
        place(v(side), self.patches[1]) * self.patches[0] + place(u(side), self.patches[0])
    }

    /// The bin of a direction that leaves by a side.
    fn bin_of(&self, side: Side, direction: DVec3) -> u32 {
        let [tangent, bitangent, _] = self.bins[0].frame(DVec3::ZERO, outwards(side));
        let square = unlifted(direction.dot(tangent), direction.dot(bitangent));
        let n = f64::from(self.directions);
        let place = |x: f64| (((x + 1.0) * 0.5 * n).max(0.0) as u32).min(self.directions - 1);
        place(square[1]) * self.directions + place(square[0])
    }
}

/// Out of an environment by a side, and into its neighbour.
fn outwards(side: Side) -> DVec3 {
    let mut normal = DVec3::ZERO;
    normal[side.axis] = if side.upper { 1.0 } else { -1.0 };
    normal
}

/// The axes along a side, in the order x, y, z.
fn u(side: Side) -> usize {
    usize::from(side.axis == 0)
}

fn v(side: Side) -> usize {
    if side.axis == 2 { 1 } else { 2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AROUND: Bounds =
        Bounds { min: DVec3::new(-1.0, 0.5, 2.0), max: DVec3::new(1.0, 2.0, 5.0) };

    /// What a bin of a wall patch emits is gathered by the same wall patch and bin, if the wall is crossed
    /// where it starts: so energy and its distribution go through a wall unchanged.
    #[test]
    fn a_wall_patch_gathers_what_it_emits() {
        let walls = VirtualWalls::new([3, 5], 6, 900).unwrap();
        for side in Side::ALL {
            let other = Side { upper: !side.upper, ..side };
            for patch in 0..walls.patches() {
                for bin in 0..walls.bins() {
                    let source = walls.emitter(&AROUND, side, [patch, bin], Rgb::ONE);
                    let rays = walls.rays_of(&source).unwrap();
                    // Back to where they came from: the neighbour's side in the same plane.
                    let (mut sum, all) = (0.0, Mask::all(rays.pixels()));
                    let behind = |(min, max): (DVec3, DVec3)| Bounds { min, max };
                    let mut neighbour = (AROUND.min, AROUND.max);
                    if side.upper {
                        neighbour.0[side.axis] = AROUND.max[side.axis];
                        neighbour.1[side.axis] += 7.0;
                    } else {
                        neighbour.1[side.axis] = AROUND.min[side.axis];
                        neighbour.0[side.axis] -= 7.0;
                    }
                    walls.gather(
                        &behind(neighbour),
                        other,
                        &source,
                        rays,
                        &all,
                        |place, weight| {
                            assert_eq!(place, [patch, bin]);
                            sum += weight;
                        },
                    );
                    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
                }
            }
        }
    }

    /// Bins have equal form factors, and the directions of any hemisphere fall into all alike.
    #[test]
    fn bins_share_the_hemisphere_equally() {
        use crate::shoot::HemisphereKind::Fibonacci;
        let walls = VirtualWalls::new([1, 1], 4, 16).unwrap();
        let hemisphere = Hemisphere::new(Fibonacci, 30_976, true).unwrap();
        let side = Side { axis: 1, upper: true };
        let source = Emitter {
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
        walls.gather(&AROUND, side, &source, &hemisphere, &all, |[_, bin], weight| {
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
