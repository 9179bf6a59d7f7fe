//! The hemisphere of directions over an emitter (§3.2): each pixel has a ray and a bit of the mask.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::directions::{concentric_pixel, equal, fibonacci, hemicube, polar};
use super::mask::Mask;
use crate::geometry::Bounds;
use crate::shoot::bundle::{Bundles, LANES, WIDTH};

/// How the directions of a hemisphere are distributed.
///
/// Choice C1: RR-3008 does not say how its hemisphere is divided into pixels. All sets but the
/// hemicube are cosine-weighted, so that all pixels have the same form factor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HemisphereKind {
    /// A Fibonacci spiral on the unit disc, projected up: the most even of these sets.
    #[default]
    Fibonacci,
    /// The upper half of a cube around the emitter, weighted by delta form factors.
    Hemicube,
    /// Rings of equal area on the disc, divided into equal sectors.
    Polar,
    /// A square of pixels mapped onto the disc (concentric map, Shirley and Chiu 1997).
    Concentric,
}

/// Directions over an emitter, and the form factor of each.
#[derive(Clone, Debug)]
pub struct Hemisphere {
    /// Unit directions in the frame of the emitter, z along its normal. Neighbours are stored
    /// together: the 64 pixels of each word of a mask form a bundle.
    pub directions: Vec<DVec3>,
    /// The same directions for the fast path.
    pub(crate) bundles: Bundles,
    /// Form factor of each pixel. They sum to 1.
    pub weights: Vec<f64>,
    /// If all pixels have the same weight: the sums of 0, 1, 2, ... of them, added one by one.
    pub(crate) sums: Option<Vec<f64>>,
    /// Whether the set is rotated about the normal by an angle derived from the position.
    pub rotated: bool,
    /// Whether it is oriented by the position, not the axes: see [`Hemisphere::by_axes`].
    by_position: bool,
}

/// A number of pixels that is not possible for a kind of hemisphere.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{pixels} pixels do not make a {kind:?} hemisphere; expected {expected}")]
pub struct HemisphereError {
    /// Requested kind.
    pub kind: HemisphereKind,
    /// Requested number of pixels.
    pub pixels: u32,
    /// Possible numbers.
    pub expected: String,
}

/// Largest number of pixels of a hemisphere. Its mask takes 2 MiB.
pub const MOST_PIXELS: u32 = 1 << 24;

impl Hemisphere {
    /// A hemisphere of `pixels` pixels. A hemicube has at most as many, to fill its faces.
    ///
    /// # Errors
    /// A number of pixels that is not possible for this kind.
    pub fn new(
        kind: HemisphereKind,
        pixels: u32,
        rotated: bool,
    ) -> Result<Hemisphere, HemisphereError> {
        let refuse = |expected: String| Err(HemisphereError { kind, pixels, expected });
        if !(1..=MOST_PIXELS).contains(&pixels) {
            return refuse(format!("1 to {MOST_PIXELS}"));
        }
        let (directions, weights) = match kind {
            HemisphereKind::Fibonacci => equal(fibonacci(pixels)),
            HemisphereKind::Polar => equal(polar(pixels)),
            HemisphereKind::Concentric => {
                let side = pixels.isqrt();
                if side * side != pixels {
                    let next = side + 1;
                    return refuse(format!("a square, such as {} or {}", side * side, next * next));
                }
                equal((0..pixels).map(|i| concentric_pixel(side, i)).collect())
            }
            HemisphereKind::Hemicube => {
                let side = (pixels / 3).isqrt() & !1;
                if side == 0 {
                    return refuse("12 or more".to_owned());
                }
                hemicube(side)
            }
        };
        Ok(Hemisphere::of(&directions, &weights, rotated))
    }

    /// The `side` × `side` rays of bin `bin` of the `n` × `n` bins of a concentric map.
    pub(crate) fn bin_of_square(n: u32, bin: u32, side: u32) -> Hemisphere {
        let row =
            |j: u32| (0..side).map(move |i| (bin / n * side + j) * n * side + bin % n * side + i);
        let pixels = (0..side).flat_map(row);
        let (directions, weights) = equal(pixels.map(|i| concentric_pixel(n * side, i)).collect());
        Hemisphere::of(&directions, &weights, false).by_axes()
    }

    /// A hemisphere of these directions, sorted into bundles.
    fn of(directions: &[DVec3], weights: &[f64], rotated: bool) -> Hemisphere {
        let mut order: Vec<u32> = (0..directions.len() as u32).collect();
        group(&mut order, directions);
        let directions: Vec<DVec3> = order.iter().map(|&i| directions[i as usize]).collect();
        let weights: Vec<f64> = order.iter().map(|&i| weights[i as usize]).collect();
        let sums = weights.iter().all(|&weight| weight == weights[0]).then(|| {
            let mut sum = 0.0;
            let add = |weight: &f64| {
                sum += weight;
                sum
            };
            std::iter::once(0.0).chain(weights.iter().map(add)).collect()
        });
        let bundles = Bundles::new(&directions);
        Hemisphere { bundles, directions, weights, sums, rotated, by_position: true }
    }

    /// The same directions, oriented by the axes. By default they are oriented by the emitter's
    /// position relative to the centre of the scene, so that they rotate with the scene.
    pub fn by_axes(self) -> Hemisphere {
        Hemisphere { by_position: false, ..self }
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u32 {
        self.directions.len() as u32
    }

    /// Sum of the form factors of the true pixels of a mask.
    pub fn form_factor(&self, mask: &Mask) -> f64 {
        match &self.sums {
            Some(sums) => sums[mask.count() as usize],
            None => mask.ones().map(|pixel| self.weights[pixel as usize]).sum(),
        }
    }

    /// Tangent, bitangent and normal of an emitter. They depend only on its centre and its normal,
    /// so that the receiver of a mask casts exactly the same rays.
    pub fn frame(&self, centre: DVec3, normal: DVec3) -> [DVec3; 3] {
        let outwards = centre - normal * centre.dot(normal);
        let tangent = if self.by_position && outwards.length() > 1e-6 * centre.length() {
            outwards.normalize()
        } else {
            perpendicular(normal)
        };
        let bitangent = normal.cross(tangent);
        let (cos, sin) = match (self.rotated, self.by_position) {
            (false, _) => (1.0, 0.0),
            (true, false) => angle_from(&centre.to_array()),
            // Lengths that do not change when the scene is rotated, except by rounding.
            (true, true) => {
                let lengths = [centre.length(), centre.dot(normal)];
                angle_from(&lengths.map(|length| f64::from(length as f32)))
            }
        };
        [tangent * cos + bitangent * sin, bitangent * cos - tangent * sin, normal]
    }

    /// The direction of a pixel, rotated into the frame of an emitter.
    pub(crate) fn direction(&self, frame: [DVec3; 3], pixel: u32) -> DVec3 {
        let [tangent, bitangent, normal] = frame;
        let d = self.directions[pixel as usize];
        tangent * d.x + bitangent * d.y + normal * d.z
    }
}

/// A unit vector perpendicular to a normal, from the axis with its smallest component.
fn perpendicular(normal: DVec3) -> DVec3 {
    DVec3::AXES[normal.abs().min_position()].cross(normal).normalize()
}

/// Cosine and sine of an angle derived from coordinates: the direction of a pseudo-random point of
/// the unit disc. All operations are exactly rounded, so all machines get the same bits.
fn angle_from(coordinates: &[f64]) -> (f64, f64) {
    let mut state = coordinates.iter().fold(0x9e37_79b9_7f4a_7c15, |state, coordinate| {
        scramble(state ^ (coordinate + 0.0).to_bits())
    });
    loop {
        state = scramble(state);
        let x = f64::from(state as u32) / f64::from(1u32 << 31) - 1.0;
        let y = f64::from((state >> 32) as u32) / f64::from(1u32 << 31) - 1.0;
        let length = (x * x + y * y).sqrt();
        if length > 0.1 && length <= 1.0 {
            return (x / length, y / length);
        }
    }
}

/// One step of the SplitMix64 generator (Steele, Lea, Flood 2014).
fn scramble(state: u64) -> u64 {
    let mut z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Sorts pixels so that each run of 64, and in it each run of 8, is compact on the disc:
/// recursively halves the longer extent at a multiple of 64 or 8.
fn group(pixels: &mut [u32], directions: &[DVec3]) {
    if pixels.len() <= LANES {
        pixels.sort_unstable();
        return;
    }
    let whole = if pixels.len() > WIDTH { WIDTH } else { LANES };
    let around = Bounds::of(pixels.iter().map(|&i| directions[i as usize]));
    let axis = usize::from(around.size().y > around.size().x);
    let at = |i: u32| directions[i as usize][axis];
    let half = pixels.len().div_ceil(whole) / 2 * whole;
    pixels.select_nth_unstable_by(half, |&a, &b| at(a).total_cmp(&at(b)).then(a.cmp(&b)));
    let (low, high) = pixels.split_at_mut(half);
    group(low, directions);
    group(high, directions);
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: [HemisphereKind; 4] = [
        HemisphereKind::Fibonacci,
        HemisphereKind::Hemicube,
        HemisphereKind::Polar,
        HemisphereKind::Concentric,
    ];

    #[test]
    fn pixels_are_unit_directions_whose_form_factors_sum_to_one() {
        for kind in KINDS {
            let hemisphere = Hemisphere::new(kind, 30_976, true).unwrap();
            assert!(hemisphere.pixels() > 29_000 && hemisphere.pixels() <= 30_976, "{kind:?}");
            assert!((hemisphere.weights.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{kind:?}");
            for d in &hemisphere.directions {
                assert!(d.z > 0.0 && (d.length() - 1.0).abs() < 1e-12, "{kind:?} {d}");
            }
        }
    }

    /// The form factor of a cap of half-angle a is sin² a.
    #[test]
    fn caps_get_their_form_factor() {
        for kind in KINDS {
            let hemisphere = Hemisphere::new(kind, 30_976, true).unwrap();
            for degrees in [10.0_f64, 30.0, 60.0, 80.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let pixels = hemisphere.directions.iter().zip(&hemisphere.weights);
                let cap: f64 = pixels.filter(|(d, _)| d.z >= cos).map(|(_, w)| w).sum();
                assert!((cap - sin * sin).abs() < 8e-3, "{kind:?} {degrees}°: {cap}");
            }
        }
    }

    #[test]
    fn frames_are_orthonormal_and_keep_an_axis_exact() {
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 16, true).unwrap();
        for normal in [DVec3::Z, -DVec3::X, DVec3::new(1.0, 2.0, -3.0).normalize()] {
            let [t, b, n] = hemisphere.frame(DVec3::new(0.1, 0.2, 0.3), normal);
            assert_eq!(n, normal);
            for (a, b) in [(t, b), (b, n), (n, t)] {
                assert!(a.dot(b).abs() < 1e-15);
            }
            assert!(t.cross(b).distance(n) < 1e-15);
        }
    }

    /// Frames oriented by position rotate with the scene about its centre.
    #[test]
    fn frames_by_position_rotate_with_the_scene() {
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 16, true).unwrap();
        let turned = |p: DVec3| DVec3::new(-p.y, p.x, p.z);
        for (centre, normal) in [([0.3, 1.7, -0.2], DVec3::Z), ([1.1, -0.4, 0.9], -DVec3::X)] {
            let centre = DVec3::from(centre);
            let frame = hemisphere.frame(centre, normal);
            let there = hemisphere.frame(turned(centre), turned(normal));
            for (here, there) in frame.into_iter().zip(there) {
                assert!(turned(here).distance(there) < 1e-15, "{here} {there}");
            }
        }
    }

    #[test]
    fn impossible_numbers_of_pixels_are_refused() {
        let error = |kind, pixels| Hemisphere::new(kind, pixels, true).unwrap_err().to_string();
        assert!(error(HemisphereKind::Concentric, 10).contains("such as 9 or 16"));
        assert!(error(HemisphereKind::Hemicube, 11).contains("12 or more"));
        assert!(error(HemisphereKind::Fibonacci, 0).contains("1 to 16777216"));
    }
}
