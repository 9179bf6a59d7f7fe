//! Convergence of form factors from patches' centres to closed forms as patches get smaller.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{closed_forms, scene, whole};
use reference::{Pair, Surface};

/// Edges of patches relative to those of the first object.
const EDGES: [f64; 4] = [0.25, 0.125, 0.062_5, 0.031_25];

/// Exact form factors from the centres of patches: the midpoint rule, whose error falls as h². Orders between the
/// last two meshes: opposed 2.00, close 2.05, aside 1.97, adjacent
/// 2.00, apart 2.00, discs 3.05 (their outline changes as well), obstructed 2.00.
#[test]
fn meshes_converge_to_every_closed_form() {
    for (name, faces, exact) in closed_forms() {
        let scene = scene(&faces);
        let [from, to] = [0, 1].map(|polygon| Surface::of_polygon(&scene, polygon));
        let pair = Pair::new(&scene, &from, &to).unwrap();
        let errors = EDGES.map(|edge| {
            let (_, environment) = whole(scene.clone(), edge);
            let patches = || environment.patches.iter().filter(|patch| patch.polygon == 0);
            let sum: f64 = patches().map(|p| p.area * pair.from_element(p.centre)).sum();
            (sum / patches().map(|patch| patch.area).sum::<f64>() / exact - 1.0).abs()
        });
        let order = (errors[2] / errors[3]).log2();
        assert!(order > 1.95 && errors[3] < 1e-3, "{name}: {order} {errors:?}");
    }
}
