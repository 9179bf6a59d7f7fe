//! Convergence of the rays of the default hemisphere to exact form factors.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{closed_forms, quad, room, scene, whole};
use radiosity::glam::DVec3;
use radiosity::{Emitter, Hemisphere, HemisphereKind, LocalEnvironment, Mask, Rgb, Space, shoot};
use reference::{ObjectRays, Objects, Pair, Surface, closed_form, element_to_polygon};

/// Sizes of the hemisphere; the default is 176².
const SIDES: [u32; 7] = [32, 45, 64, 90, 128, 176, 256];

/// The exponent p of the best fit N^−p to the errors at all sizes.
fn order(errors: [f64; SIDES.len()]) -> f64 {
    let x = SIDES.map(|side| f64::from(side * side).ln());
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let covariance: f64 = x.iter().zip(errors).map(|(x, error)| (x - mean) * error.ln()).sum();
    -covariance / x.iter().map(|x| (x - mean).powi(2)).sum::<f64>()
}

fn hemisphere(side: u32) -> Hemisphere {
    Hemisphere::new(HemisphereKind::Fibonacci, side * side, true).unwrap()
}

/// Form factors by rays from a point of a polygon to all patches.
fn by_rays(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    (polygon, centre): (u32, DVec3),
) -> Vec<f64> {
    let normal = space.scene.polygons[polygon as usize].plane.normal;
    let (power, radiosity) = (Rgb::ONE, Rgb::ONE);
    let source = Emitter { environment: 0, patch: 0, polygon, centre, normal, power, radiosity };
    let mask = Mask::all(hemisphere.pixels());
    let mut found = vec![0.0; environment.patches.len()];
    for (patch, form_factor) in shoot(space, environment, hemisphere, &source, &mask).hits {
        found[patch as usize] = form_factor;
    }
    found
}

/// The energy that arrives at a wrong patch, over forty sources in an empty room of 4 × 4 × 3 m with 320 patches
/// of half a metre, falls as N^−0.79 or faster and is at most 0.5 % at 176².
#[test]
fn misdirected_energy_decreases() {
    // Walls of 2 m and of 1 m, since patches are made by halving.
    let mut faces = room([4.0, 4.0, 3.0]);
    for wall in faces.split_off(2) {
        for [low, high] in [[0.0, 2.0], [2.0, 3.0]] {
            let mut part = wall.clone();
            part.points.iter_mut().for_each(|p| p.z = if p.z == 0.0 { low } else { high });
            faces.push(part);
        }
    }
    let (space, environment) = whole(scene(&faces), 0.5);
    let patches = &environment.patches;
    assert_eq!(patches.len(), 320);
    let outlines: Vec<Vec<DVec3>> =
        (0..patches.len() as u32).map(|patch| environment.outline(&space, patch)).collect();
    let sources: Vec<(u32, DVec3, Vec<f64>)> = (0..40)
        .map(|i| {
            let patch = &patches[i * patches.len() / 40 + 3];
            let normal = space.scene.polygons[patch.polygon as usize].plane.normal;
            let exact = |to: &Vec<DVec3>| element_to_polygon(patch.centre, normal, to).max(0.0);
            (patch.polygon, patch.centre, outlines.iter().map(exact).collect())
        })
        .collect();
    let misdirected = SIDES.map(|side| {
        let hemisphere = hemisphere(side);
        let of = |(polygon, centre, exact): &(u32, DVec3, Vec<f64>)| {
            let found = by_rays(&space, &environment, &hemisphere, (*polygon, *centre));
            0.5 * found.iter().zip(exact).map(|(found, exact)| (found - exact).abs()).sum::<f64>()
        };
        sources.iter().map(of).sum::<f64>() / sources.len() as f64
    });
    assert!(order(misdirected) >= 0.79, "{} {misdirected:?}", order(misdirected));
    assert!(misdirected[5] <= 5e-3, "{misdirected:?}");
}

/// Root mean square error from sixty-four points: the error of a lattice of N points over a region with an edge
/// falls as N^−3/4. With sixty-four points the fitted order is accurate to 0.025.
#[test]
fn rays_converge_to_every_closed_form() {
    let mut orders = Vec::new();
    for (name, faces, _) in closed_forms() {
        let (space, environment) = whole(scene(&faces), f64::INFINITY);
        let [from, to] = [0, 1].map(|polygon| Surface::of_polygon(&space.scene, polygon));
        let pair = Pair::new(&space.scene, &from, &to).unwrap();
        let point = |i: u32| {
            let [u, v] = [0.754_877, 0.569_840].map(|step| (0.5 + step * f64::from(i)).fract());
            let across = from.corners.len() / 2;
            let [a, b, c] = [0, across / 2, across].map(|corner| from.corners[corner]);
            // Half of a square or of a disc.
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            b + (a - b) * u + (c - b) * v
        };
        let exact: Vec<f64> = (0..64).map(|i| pair.from_element(point(i))).collect();
        let errors = SIDES.map(|side| {
            let hemisphere = hemisphere(side);
            let off = |(i, exact): (u32, &f64)| {
                by_rays(&space, &environment, &hemisphere, (0, point(i)))[1] - exact
            };
            let squares: f64 = (0..).zip(&exact).map(|at| off(at).powi(2)).sum();
            (squares / 64.0).sqrt()
        });
        orders.push((name, order(errors)));
        assert!(errors[5] < 2e-4, "{name}: {errors:?}");
    }
    assert!(orders.iter().all(|&(_, order)| order > 0.75 - 2.0 * 0.025), "{orders:?}");
    let mean = orders.iter().map(|&(_, order)| order).sum::<f64>() / orders.len() as f64;
    assert!(mean >= 0.75, "{mean} {orders:?}");
}

/// The same from elements to rectangles of sixty-four shapes that have a closed form.
#[test]
fn rays_converge_to_every_closed_form_of_an_element() {
    let side = |i: u32, step: f64| 0.3 + 1.4 * (0.5 + step * f64::from(i)).fract();
    let parallel = |i: u32| {
        let [a, b, c] = [0.754_877, 0.569_840, 0.366_025].map(|step| side(i, step));
        let target = [[0.0, 0.0, c], [0.0, b, c], [a, b, c], [a, 0.0, c]];
        (target, closed_form::element_to_parallel_rectangle(a, b, c))
    };
    let perpendicular = |i: u32| {
        let [a, b, c] = [0.754_877, 0.569_840, 0.366_025].map(|step| side(i, step));
        let target = [[c, 0.0, 0.0], [c, 0.0, a], [c, b, a], [c, b, 0.0]];
        (target, closed_form::element_to_perpendicular_rectangle(a, b, c))
    };
    for (name, of) in
        [("parallel", &parallel as &dyn Fn(u32) -> _), ("perpendicular", &perpendicular)]
    {
        let element = |shift: f64| {
            let at = |x: f64, y: f64| [x + shift, y, 0.0];
            quad([at(-0.1, -0.1), at(0.1, -0.1), at(0.1, 0.1), at(-0.1, 0.1)], 0)
        };
        let cases: Vec<_> = (0..64)
            .map(|i| {
                let (target, exact) = of(i);
                let (space, environment) =
                    whole(scene(&[element(0.0), quad(target, 1)]), f64::INFINITY);
                let origin = -space.scene.origin;
                (space, environment, origin, exact)
            })
            .collect();
        let errors = SIDES.map(|side| {
            let hemisphere = hemisphere(side);
            let squares = cases.iter().map(|(space, environment, origin, exact)| {
                let found = by_rays(space, environment, &hemisphere, (0, *origin));
                (found[1] - exact).powi(2)
            });
            (squares.sum::<f64>() / 64.0).sqrt()
        });
        assert!(order(errors) > 0.75 - 2.0 * 0.025, "{name}: {} {errors:?}", order(errors));
        assert!(errors[5] < 2e-4, "{name}: {errors:?}");
    }
}

/// Rays from points all over an object agree with the form factor within their standard errors.
#[test]
fn object_rays_agree_with_every_closed_form() {
    let mut squares = 0.0;
    for (name, faces, exact) in closed_forms() {
        let (space, _) = whole(scene(&faces), 1.0);
        let objects = Objects::new(&space.scene);
        let found = ObjectRays::new(&objects, &space, 1 << 21, 7).unwrap().from(0)[1];
        let off = (found.value - exact) / found.error;
        assert!(found.error < 2e-3 && off.abs() < 4.0, "{name}: {found:?} {exact}");
        squares += off * off / 7.0;
    }
    assert!(squares < 3.0, "{squares}");
}
