//! Form factors that other programs compute: View3D 4.0.0 (github.com/jasondegraw/View3D) of its own examples, with
//! `eps=1.e-7` and no normalisation, and pyViewFactor 1.1.0 (pypi.org) of pairs of triangles and squares.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::grey;
use radiosity::glam::DVec3;
use radiosity::{Face, Scene};
use reference::Objects;

/// View3D prints six digits, and its obstructed form factors are less exact than that: rows of the closed room sum
/// to 1.000002 there, ours to 1 within 1e-6.
const DIGITS: f64 = 5e-6;

fn scene(vertices: &[[f64; 3]], surfaces: &[(&[usize], u32)]) -> Scene {
    let face = |&(corners, object): &(&[usize], u32)| Face {
        points: corners.iter().map(|&corner| DVec3::from(vertices[corner - 1])).collect(),
        material: 0,
        object,
    };
    let faces: Vec<Face> = surfaces.iter().map(face).collect();
    let objects = (1..=8).map(|number| format!("srf-{number}")).collect();
    Scene::new(&faces, vec![grey(0.5, 0.0)], objects).unwrap().0
}

fn compare(scene: &Scene, one: usize, other: usize, expected: f64) -> f64 {
    let [found, _] = Objects::new(scene).exact(one, other, 1e-7);
    let difference = (found.value - expected).abs();
    assert!(difference <= DIGITS + found.error, "{one} to {other}: {found:?}, peer {expected}");
    found.value
}

/// `square-obstruction.vs3`: two squares with a square obstruction in between.
#[test]
fn squares_with_an_obstruction() {
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
        [0.0, 0.0, 0.5],
        [0.5, 0.0, 0.5],
        [0.5, 0.5, 0.5],
        [0.0, 0.5, 0.5],
    ];
    let surfaces: [(&[usize], u32); 3] =
        [(&[1, 2, 3, 4], 0), (&[7, 6, 5, 8], 1), (&[9, 10, 11, 12], 2)];
    let scene = scene(&vertices, &surfaces);
    compare(&scene, 0, 1, 0.149869);
    compare(&scene, 1, 2, 0.103813);
    compare(&scene, 2, 1, 0.415253);
}

/// `pinney-bean-test-4.vs3`: an L-shaped room, whose floor and ceiling are three squares each.
#[test]
fn an_l_shaped_room() {
    let vertices = [
        [0.0, 3.0, 3.0],
        [1.0, 3.0, 3.0],
        [0.0, 3.0, 0.0],
        [1.0, 3.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [3.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [0.0, 0.0, 3.0],
        [1.0, 0.0, 3.0],
        [3.0, 0.0, 3.0],
        [0.0, 1.0, 3.0],
        [1.0, 1.0, 3.0],
        [3.0, 1.0, 3.0],
    ];
    let surfaces: [(&[usize], u32); 12] = [
        (&[11, 13, 10, 8], 0),
        (&[10, 13, 16, 7], 1),
        (&[6, 7, 16, 15], 2),
        (&[4, 6, 15, 2], 3),
        (&[3, 4, 2, 1], 4),
        (&[8, 3, 1, 11], 5),
        (&[11, 14, 15, 12], 6),
        (&[8, 9, 6, 5], 7),
        (&[1, 2, 15, 14], 6),
        (&[15, 16, 13, 12], 6),
        (&[5, 6, 4, 3], 7),
        (&[9, 10, 7, 6], 7),
    ];
    let scene = scene(&vertices, &surfaces);
    let rows = [
        [0.0, 0.113154, 0.378093, 0.027473, 0.032891, 0.182356, 0.133017, 0.133017],
        [0.339463, 0.0, 0.318997, 0.0, 0.0, 0.098674, 0.121434, 0.121434],
        [0.567139, 0.159498, 0.0, 0.0, 0.0, 0.041210, 0.116076, 0.116076],
        [0.041210, 0.0, 0.0, 0.0, 0.159498, 0.567139, 0.116076, 0.116076],
        [0.098674, 0.0, 0.0, 0.318997, 0.0, 0.339463, 0.121434, 0.121434],
        [0.182356, 0.032891, 0.027473, 0.378093, 0.113154, 0.0, 0.133017, 0.133017],
        [0.239430, 0.072861, 0.139291, 0.139291, 0.072861, 0.239430, 0.0, 0.096836],
        [0.239430, 0.072861, 0.139291, 0.139291, 0.072861, 0.239430, 0.096836, 0.0],
    ];
    for (one, row) in rows.iter().enumerate() {
        let others = row.iter().enumerate().filter(|&(other, _)| other != one);
        let sum: f64 = others.map(|(other, &expected)| compare(&scene, one, other, expected)).sum();
        assert!((sum - 1.0).abs() < 1e-6, "{one}: {sum}");
    }
}

/// `compute_viewfactor(to, from)` of pyViewFactor, from a triangle to what is above it or at its edge.
#[test]
fn a_triangle_and_others() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let others: [(&[[f64; 3]], f64); 4] = [
        (&[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]], 0.11504923),
        (&[[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [2.0, 0.0, 1.0]], 0.06248462),
        (&[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]], 0.26766251),
        (&[[0.2, 0.1, 0.5], [0.4, 1.2, 0.9], [1.1, 0.3, 0.8]], 0.13766674),
    ];
    for (other, expected) in others {
        let vertices = [&triangle[..], other].concat();
        let numbers: Vec<usize> = (1..=vertices.len()).collect();
        compare(&scene(&vertices, &[(&numbers[..3], 0), (&numbers[3..], 1)]), 0, 1, expected);
    }
}
