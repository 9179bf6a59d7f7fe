//! The hemisphere of directions over a source: a pixel, a ray, a bit of the mask (§3.2).

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use thiserror::Error;

use super::mask::Mask;
use crate::geometry::Bounds;
use crate::shoot::bundle::{Bundles, LANES, WIDTH};

/// How the pixels of a hemisphere are laid out.
///
/// Choice C1: RR-3008 says "a hemisphere" and leaves its pixels open. All sets but the hemicube are
/// weighted by the cosine, so that a pixel is worth the same form factor everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HemisphereKind {
    /// A Fibonacci spiral on the unit disc, lifted to the hemisphere: the most even of these sets.
    Fibonacci,
    /// The five half-faces of a cube around the source, weighted by delta form factors.
    Hemicube,
    /// Rings of equal area on the disc, cut into equal sectors.
    Polar,
    /// A square of pixels mapped onto the disc ring by ring (Shirley and Chiu).
    Concentric,
}

/// Directions over a source and the form factor that each stands for.
#[derive(Clone, Debug)]
pub struct Hemisphere {
    /// Unit directions in the source's frame, z along its normal; neighbours stand together, 64 to a
    /// word of a mask.
    pub directions: Vec<DVec3>,
    pub(crate) bundles: Bundles,
    /// Form factor of each pixel; they sum to 1.
    pub weights: Vec<f64>,
    /// Where all pixels have one weight: the sum of none, one, two and so on of them, added one by one.
    pub(crate) sums: Option<Vec<f64>>,
    /// Whether the set is turned about the normal by an angle of the source's own.
    pub rotated: bool,
    /// Whether it is laid by the source's place in the scene rather than by the axes: see [`Hemisphere::by_axes`].
    by_place: bool,
}

/// A number of pixels that a kind of hemisphere cannot have.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{pixels} pixels do not make a {kind:?} hemisphere; expected {expected}")]
pub struct HemisphereError {
    /// What was asked for.
    pub kind: HemisphereKind,
    /// What was asked for.
    pub pixels: u32,
    /// What would do.
    pub expected: String,
}

/// The most pixels that a hemisphere may have; a mask of so many takes 2 MiB.
pub const MOST_PIXELS: u32 = 1 << 24;

impl Hemisphere {
    /// A hemisphere of `pixels` pixels; a hemicube takes as many of them as fill its faces.
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
                equal(concentric(side))
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

    /// Bin `bin` of the `n` × `n` of a concentric square of directions, with `side` × `side` rays.
    pub(crate) fn bin_of_square(n: u32, bin: u32, side: u32) -> Hemisphere {
        let row =
            |j: u32| (0..side).map(move |i| (bin / n * side + j) * n * side + bin % n * side + i);
        let pixels = (0..side).flat_map(row);
        let (directions, weights) = equal(pixels.map(|i| concentric_pixel(n * side, i)).collect());
        Hemisphere::of(&directions, &weights, false).by_axes()
    }

    /// A hemisphere of these directions, put in order.
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
        Hemisphere { bundles, directions, weights, sums, rotated, by_place: true }
    }

    /// The same directions laid over each source by the axes. As made they are laid by where it lies from
    /// the scene's centre, so that they turn with the scene: a turned scene gets the same rays, turned.
    pub fn by_axes(self) -> Hemisphere {
        Hemisphere { by_place: false, ..self }
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u32 {
        self.directions.len() as u32
    }

    /// Form factor of all true pixels of a mask.
    pub fn form_factor(&self, mask: &Mask) -> f64 {
        match &self.sums {
            Some(sums) => sums[mask.count() as usize],
            None => mask.ones().map(|pixel| self.weights[pixel as usize]).sum(),
        }
    }

    /// Tangent, bitangent and normal over a source with its centre at `centre`. Whoever knows the
    /// centre and the normal, exactly, gets the same frame: a mask's receiver casts the same rays.
    pub fn frame(&self, centre: DVec3, normal: DVec3) -> [DVec3; 3] {
        let outwards = centre - normal * centre.dot(normal);
        let tangent = if self.by_place && outwards.length() > 1e-6 * centre.length() {
            outwards.normalize()
        } else {
            across(normal)
        };
        let bitangent = normal.cross(tangent);
        let (cos, sin) = match (self.rotated, self.by_place) {
            (false, _) => (1.0, 0.0),
            (true, false) => turn(&centre.to_array()),
            // What does not change when the scene is turned, rounding apart.
            (true, true) => {
                let lengths = [centre.length(), centre.dot(normal)];
                turn(&lengths.map(|length| f64::from(length as f32)))
            }
        };
        [tangent * cos + bitangent * sin, bitangent * cos - tangent * sin, normal]
    }
}

/// A unit vector across a normal, by the axis that is least along it.
fn across(normal: DVec3) -> DVec3 {
    let least = if normal.x.abs() <= normal.y.abs() && normal.x.abs() <= normal.z.abs() {
        DVec3::X
    } else if normal.y.abs() <= normal.z.abs() {
        DVec3::Y
    } else {
        DVec3::Z
    };
    least.cross(normal).normalize()
}

/// Cosine and sine of an angle derived from a source's coordinates: the direction of a pseudo-random
/// point of the unit disc, so that only exactly rounded operations are needed and every machine
/// finds the same bits.
fn turn(coordinates: &[f64]) -> (f64, f64) {
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

/// Put pixels in an order in which each run of 64 lies together on the disc, and in it each run of 8:
/// halve the longer extent at a multiple of that until no more are left.
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

fn equal(directions: Vec<DVec3>) -> (Vec<DVec3>, Vec<f64>) {
    let weights = vec![1.0 / directions.len() as f64; directions.len()];
    (directions, weights)
}

/// A point of the unit disc lifted onto the hemisphere: equal areas become equal form factors
/// (Nusselt's analogue).
fn lifted(r: f64, phi: f64) -> DVec3 {
    DVec3::new(r * libm::cos(phi), r * libm::sin(phi), (1.0 - r * r).max(0.0).sqrt())
}

fn fibonacci(pixels: u32) -> Vec<DVec3> {
    let golden_turn = TAU * (3.0 - 5f64.sqrt()) / 2.0;
    let n = f64::from(pixels);
    (0..pixels)
        .map(f64::from)
        .map(|i| lifted(((i + 0.5) / n).sqrt(), (i * golden_turn) % TAU))
        .collect()
}

fn polar(pixels: u32) -> Vec<DVec3> {
    // Rings and sectors such that pixels are about square: four times as many sectors as rings,
    // or as near to that as the divisors of the number allow.
    let wanted = f64::from(pixels / 4).sqrt().max(1.0) as u32;
    let rings = (1..=wanted).rev().find(|rings| pixels.is_multiple_of(*rings)).unwrap_or(1);
    let sectors = pixels / rings;
    let pixel = |i: u32| {
        let (ring, sector) = (f64::from(i / sectors), f64::from(i % sectors));
        let r = ((ring + 0.5) / f64::from(rings)).sqrt();
        lifted(r, TAU * (sector + 0.5) / f64::from(sectors))
    };
    (0..pixels).map(pixel).collect()
}

fn concentric(side: u32) -> Vec<DVec3> {
    (0..side * side).map(|i| concentric_pixel(side, i)).collect()
}

fn concentric_pixel(side: u32, i: u32) -> DVec3 {
    let at = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(side) - 1.0;
    let (x, y) = (at(i % side), at(i / side));
    if x == 0.0 && y == 0.0 {
        DVec3::Z
    } else if x.abs() > y.abs() {
        lifted(x, PI / 4.0 * (y / x))
    } else {
        lifted(y, PI / 2.0 - PI / 4.0 * (x / y))
    }
}

/// Where the concentric map has a direction, given by its two components across the normal, from: a point
/// of the square from -1 to 1.
pub(crate) fn unlifted(x: f64, y: f64) -> [f64; 2] {
    let r = (x * x + y * y).sqrt();
    if r == 0.0 {
        [0.0; 2]
    } else if x.abs() > y.abs() {
        let r = r.copysign(x);
        [r, r * libm::atan(y / x) * 4.0 / PI]
    } else {
        let r = r.copysign(y);
        [r * libm::atan(x / y) * 4.0 / PI, r]
    }
}

/// Top face of side × side pixels, then four half-faces (Cohen and Greenberg 1985).
fn hemicube(side: u32) -> (Vec<DVec3>, Vec<f64>) {
    let half = side / 2;
    let at = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(side) - 1.0;
    let top = (0..side * side).map(|i| DVec3::new(at(i % side), at(i / side), 1.0));
    let sides = (0..4).flat_map(|face| {
        (0..side * half).map(move |i| {
            let (along, up) = (at(i % side), at(half + i / side));
            match face {
                0 => DVec3::new(1.0, along, up),
                1 => DVec3::new(-along, 1.0, up),
                2 => DVec3::new(-1.0, -along, up),
                _ => DVec3::new(along, -1.0, up),
            }
        })
    });
    let points: Vec<DVec3> = top.chain(sides).collect();
    // Delta form factor up to a constant: the height above the source's plane over distance⁴.
    let raw: Vec<f64> = points.iter().map(|p| p.z / p.length_squared().powi(2)).collect();
    let sum: f64 = raw.iter().sum();
    // Multiples of 2⁻⁵³: their sums are exact, in whatever order pixels are added up.
    let unit = 2f64.powi(53);
    let weights = raw.iter().map(|w| (w / sum * unit).round() / unit).collect();
    (points.iter().map(|p| p.normalize()).collect(), weights)
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

    /// By place, frames turn with the scene about its centre.
    #[test]
    fn frames_by_place_turn_with_the_scene() {
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
