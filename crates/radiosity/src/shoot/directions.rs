//! Sets of directions over an emitter, with the form factor of each direction.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// Directions of equal form factor.
pub(super) fn equal(directions: Vec<DVec3>) -> (Vec<DVec3>, Vec<f64>) {
    let weights = vec![1.0 / directions.len() as f64; directions.len()];
    (directions, weights)
}

/// A point of the unit disc, projected up onto the hemisphere. Equal areas of the disc have equal
/// form factors (Nusselt's analogue).
fn lifted(r: f64, phi: f64) -> DVec3 {
    DVec3::new(r * libm::cos(phi), r * libm::sin(phi), (1.0 - r * r).max(0.0).sqrt())
}

/// Points along a Fibonacci spiral on the disc.
pub(super) fn fibonacci(pixels: u32) -> Vec<DVec3> {
    let golden_turn = TAU * (3.0 - 5f64.sqrt()) / 2.0;
    let n = f64::from(pixels);
    (0..pixels)
        .map(f64::from)
        .map(|i| lifted(((i + 0.5) / n).sqrt(), (i * golden_turn) % TAU))
        .collect()
}

/// Centres of equal sectors of rings of equal area.
pub(super) fn polar(pixels: u32) -> Vec<DVec3> {
    // Pixels are about square with four times as many sectors as rings.
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

/// Pixel `i` of the concentric map of a square with `side` × `side` pixels (Shirley and Chiu 1997).
pub(super) fn concentric_pixel(side: u32, i: u32) -> DVec3 {
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

/// Inverse of the concentric map: from tangential components to the square [-1, 1]².
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

/// A hemicube: a top face of `side` × `side` pixels and four half-faces (Cohen and Greenberg 1985).
pub(super) fn hemicube(side: u32) -> (Vec<DVec3>, Vec<f64>) {
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
    // Delta form factor up to a constant: height above the plane of the emitter over distance⁴.
    let raw: Vec<f64> = points.iter().map(|p| p.z / p.length_squared().powi(2)).collect();
    let sum: f64 = raw.iter().sum();
    // Multiples of 2⁻⁵³, so that sums are exact in any order.
    let unit = 2f64.powi(53);
    let weights = raw.iter().map(|w| (w / sum * unit).round() / unit).collect();
    (points.iter().map(|p| p.normalize()).collect(), weights)
}
