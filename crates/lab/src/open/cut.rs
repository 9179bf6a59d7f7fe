//! The straightforward, automatic decomposition: near-cubic cells, near-cubic environments.

use crate::files::counts::{Counts, Triple};

/// Most cells along one axis that the automatic grid makes.
const MOST_CELLS: u32 = 128;

/// Cells for a scene of these extents (m): about one a polygon, near to cubes, and a multiple of
/// the cut along each axis.
pub fn automatic_cells(extents: [f64; 3], polygons: usize, cut: Triple) -> Triple {
    let edges = extents.map(|extent| extent.max(0.0));
    let solid: Vec<f64> = edges.into_iter().filter(|&edge| edge > 0.0).collect();
    let size: f64 = solid.iter().product();
    // The edge of a cell, so that `polygons` cells fill the axes that have an extent.
    let edge = (size / polygons.max(1) as f64).powf(1.0 / solid.len().max(1) as f64);
    let mut cells = [1; 3];
    for axis in 0..3 {
        // A cast from f64 saturates, and takes 0/0 to 0.
        let wanted = ((edges[axis] / edge).round() as u32).clamp(1, MOST_CELLS);
        cells[axis] = wanted.next_multiple_of(cut.0[axis]);
    }
    Counts(cells)
}

/// The cut into `environments` boxes that are nearest to cubes: of those whose planes share the
/// cells out evenly, else of those that leave a cell to every environment, the one whose boxes
/// have the least surface. `None` if no cut leaves a cell to every environment.
pub fn automatic_cut(
    extents: [f64; 3],
    environments: u32,
    cells: Option<Triple>,
) -> Option<Triple> {
    let fits = |cut: &[u32; 3]| cells.is_none_or(|cells| (0..3).all(|a| cut[a] <= cells.0[a]));
    let even = |cut: &[u32; 3]| {
        cells.is_none_or(|cells| (0..3).all(|a| cells.0[a].is_multiple_of(cut[a])))
    };
    let surface = |cut: &[u32; 3]| {
        let [x, y, z] = [0, 1, 2].map(|axis| extents[axis] / f64::from(cut[axis]));
        x * y + y * z + z * x
    };
    factorisations(environments)
        .filter(fits)
        .min_by(|a, b| even(b).cmp(&even(a)).then(surface(a).total_cmp(&surface(b))))
        .map(Counts)
}

/// All ways to write `n` as a product of three, in the order of the first two.
fn factorisations(n: u32) -> impl Iterator<Item = [u32; 3]> {
    let divisors = |n: u32| (1..=n).filter(move |d| n.is_multiple_of(*d));
    divisors(n).flat_map(move |x| divisors(n / x).map(move |y| [x, y, n / x / y]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn environments_come_near_to_cubes() {
        let cut = |extents, n| automatic_cut(extents, n, None).map(|cut| cut.to_string());
        assert_eq!(cut([8.0, 4.0, 1.0], 32), Some("8x4x1".to_owned()));
        assert_eq!(cut([1.0, 1.0, 1.0], 8), Some("2x2x2".to_owned()));
        assert_eq!(cut([10.0, 1.0, 1.0], 7), Some("7x1x1".to_owned()));
        assert_eq!(cut([1.0, 1.0, 1.0], 1), Some("1x1x1".to_owned()));
    }

    #[test]
    fn cut_planes_share_cells_out_evenly_where_they_can() {
        let cut = |cells, n| automatic_cut([1.0; 3], n, Some(Counts(cells)));
        assert_eq!(cut([8, 1, 1], 8), Some(Counts([8, 1, 1])));
        assert_eq!(cut([3, 4, 4], 4), Some(Counts([1, 2, 2])));
        assert_eq!(cut([5, 1, 1], 3), Some(Counts([3, 1, 1])));
        assert_eq!(cut([2, 1, 1], 7), None);
    }

    #[test]
    fn cells_are_near_to_cubes_and_divide_by_the_cut() {
        let cells = |extents, polygons, cut| automatic_cells(extents, polygons, Counts(cut)).0;
        assert_eq!(cells([8.0, 4.0, 2.0], 64, [1; 3]), [8, 4, 2]);
        assert_eq!(cells([8.0, 4.0, 2.0], 64, [3, 1, 1]), [9, 4, 2]);
        assert_eq!(cells([4.0, 4.0, 0.0], 16, [1; 3]), [4, 4, 1]);
        assert_eq!(cells([1e9, 1e-9, 1.0], 1000, [1; 3])[0], MOST_CELLS);
    }
}
