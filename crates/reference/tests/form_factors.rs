//! Form factors by quadrature compared with closed forms.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{quad, room, scene};
use radiosity::glam::DVec3;
use reference::closed_form::{
    adjacent_rectangles, coaxial_discs, element_to_parallel_rectangle,
    element_to_perpendicular_rectangle, opposed_rectangles, parallel_rectangles,
    perpendicular_rectangles,
};
use reference::{Objects, element_to_polygon};

/// Checks that the form factor from object 0 to object 1 is `exact` within its error.
fn holds(faces: &[radiosity::Face], exact: f64, tolerance: f64) {
    let scene = scene(faces);
    let [found, _] = Objects::new(&scene).exact(0, 1, tolerance);
    assert!(found.error <= tolerance, "{found:?}");
    assert!((found.value - exact).abs() <= found.error + 1e-12, "{found:?} {exact}");
}

#[test]
fn elements() {
    let square = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
    let found = element_to_polygon(DVec3::ZERO, DVec3::Z, &square.map(DVec3::from));
    assert!((found - element_to_parallel_rectangle(1.0, 1.0, 1.0)).abs() < 1e-15);
    // Half of it is below the horizon.
    let wall = [[1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]];
    let found = element_to_polygon(DVec3::ZERO, DVec3::Z, &wall.map(DVec3::from));
    assert!((found - element_to_perpendicular_rectangle(1.0, 1.0, 1.0)).abs() < 1e-15);
}

#[test]
fn rectangles() {
    let floor_and = |quads: &[[[f64; 3]; 4]]| {
        let floor = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let others = quads.iter().map(|&points| quad(points, 1));
        std::iter::once(quad(floor, 0)).chain(others).collect::<Vec<_>>()
    };
    let opposed =
        |z: f64| floor_and(&[[[0.0, 0.0, z], [0.0, 1.0, z], [1.0, 1.0, z], [1.0, 0.0, z]]]);
    holds(&opposed(1.0), opposed_rectangles(1.0, 1.0, 1.0), 1e-10);
    holds(&opposed(0.1), opposed_rectangles(1.0, 1.0, 0.1), 1e-10);
    let aside = [[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [2.0, 0.0, 1.0]];
    let unit = [0.0, 1.0];
    let exact = parallel_rectangles([unit, unit], [[1.0, 2.0], unit], 1.0);
    holds(&floor_and(&[aside]), exact, 1e-10);
    let adjacent = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]];
    holds(&floor_and(&[adjacent]), adjacent_rectangles(1.0, 1.0, 1.0), 1e-9);
    let away = adjacent.map(|[x, y, z]| [x - 1.0, y, z]);
    let exact = perpendicular_rectangles([[1.0, 2.0], unit], [unit, unit]);
    holds(&floor_and(&[away]), exact, 1e-10);
}

/// Regular polygons inscribed in discs: the error falls as the square of an edge's angle.
#[test]
fn discs() {
    let exact = coaxial_discs(1.0, 1.0, 1.0);
    let error = |edges: u32| {
        let ring = |z: f64, turn: f64| {
            let corner = |i: u32| {
                let (sin, cos) =
                    (turn * std::f64::consts::TAU * f64::from(i) / f64::from(edges)).sin_cos();
                DVec3::new(cos, sin, z)
            };
            (0..edges).map(corner).collect()
        };
        let faces = [(0, ring(0.0, 1.0)), (1, ring(1.0, -1.0))];
        let faces = faces.map(|(object, points)| radiosity::Face { points, material: 0, object });
        Objects::new(&scene(&faces)).exact(0, 1, 1e-9)[0].value - exact
    };
    let errors = [16, 32, 64].map(error);
    assert!(errors[2].abs() < 1e-3, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.1, "{errors:?}");
    }
}

/// Unit squares at distance 1 with [0,½]² midway: 0.1498686718, known to 1e-6 by two methods.
#[test]
fn obstructed_squares() {
    let mut faces = room([1.0; 3]);
    faces.truncate(2);
    let (l, h, z) = (0.0, 0.5, 0.5);
    faces.push(quad([[l, l, z], [h, l, z], [h, h, z], [l, h, z]], 2));
    holds(&faces, 0.149_868_671_8, 1e-8);
}

/// A room with a table: form factors from each object sum to 1.
#[test]
fn rows_of_a_closed_room_sum_to_one() {
    let mut faces = room([4.0, 3.0, 2.5]);
    // The table is a floating box, seen from outside.
    let [x0, y0, z0, x1, y1, z1] = [1.0, 1.0, 0.6, 2.0, 1.7, 0.8];
    let boxed = room([x1 - x0, y1 - y0, z1 - z0]);
    faces.extend(boxed.into_iter().map(|mut face| {
        face.points.iter_mut().for_each(|p| *p += DVec3::new(x0, y0, z0));
        face.points.reverse();
        face.object = 3;
        face
    }));
    let scene = scene(&faces);
    let objects = Objects::new(&scene);
    for from in 0..objects.count() {
        let row = (0..objects.count()).map(|to| objects.exact(from, to, 1e-5)[0]);
        let sum: reference::Estimate = row.sum();
        assert!((sum.value - 1.0).abs() <= sum.error, "{}: {sum:?}", objects.name(from));
    }
}

/// Where two polygons of one plane overlap, one of them counts, as for rays.
#[test]
fn covered_parts_do_not_count() {
    let square = |low: f64, high: f64, z: f64| {
        [[low, 0.0, z], [high, 0.0, z], [high, 1.0, z], [low, 1.0, z]]
    };
    let mut lamp = square(0.0, 1.0, 1.0);
    lamp.reverse();
    let (first, second) = (square(0.0, 1.0, 0.0), square(0.5, 1.5, 0.0));
    let scene = scene(&[quad(lamp, 0), quad(first, 1), quad(second, 2)]);
    let [there, _] = Objects::new(&scene).exact(0, 2, 1e-10);
    let unit = [0.0, 1.0];
    let exact = parallel_rectangles([unit, unit], [[1.0, 1.5], unit], 1.0);
    assert!((there.value - exact).abs() < 1e-10, "{there:?} {exact}");
}
