//! Adaptive integration over triangles.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use radiosity::glam::DVec3;

use crate::form_factors::gauss::{Order, over_triangle};

/// A value and its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// The difference from a coarser rule, summed over all parts as absolute values.
    pub error: f64,
}

/// The greatest error allowed: the absolute or the relative one, whichever is greater.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// In the unit of the value.
    pub absolute: f64,
    /// As a fraction of the value.
    pub relative: f64,
}

impl Tolerance {
    fn allows(&self, estimate: Estimate) -> bool {
        estimate.error <= self.absolute.max(self.relative * estimate.value.abs())
    }
}

impl Estimate {
    /// The estimate divided by a positive number.
    pub(crate) fn over(self, divisor: f64) -> Estimate {
        Estimate { value: self.value / divisor, error: self.error / divisor }
    }
}

impl std::ops::Add for Estimate {
    type Output = Estimate;

    fn add(self, other: Estimate) -> Estimate {
        Estimate { value: self.value + other.value, error: self.error + other.error }
    }
}

impl std::iter::Sum for Estimate {
    fn sum<I: Iterator<Item = Estimate>>(terms: I) -> Estimate {
        terms.fold(Estimate::default(), std::ops::Add::add)
    }
}

/// A triangle over which one of several functions is integrated.
#[derive(Clone, Copy)]
pub(crate) struct Part {
    pub(crate) triangle: [DVec3; 3],
    /// The number of the function.
    pub(crate) function: usize,
    /// Whether it has derivatives of all orders; otherwise rules of high order do not help.
    pub(crate) smooth: bool,
}

struct Cell {
    part: Part,
    order: Order,
    estimate: Estimate,
}

/// Refinement stops at this number of cells; the error then states what was reached.
const MOST_CELLS: usize = 200_000;

/// The sum of the integrals of `f(function, point)` over all parts. The cell with the greatest
/// error gets a rule of higher order or is split into four, until the sum of all errors is small enough.
pub(crate) fn integrate(
    parts: impl IntoIterator<Item = Part>,
    tolerance: Tolerance,
    f: impl Fn(usize, DVec3) -> f64,
) -> Estimate {
    let mut cells: BinaryHeap<Cell> = parts.into_iter().map(|part| Cell::new(part, &f)).collect();
    let mut sum: Estimate = cells.iter().map(|cell| cell.estimate).sum();
    let most = MOST_CELLS + cells.len();
    while !tolerance.allows(sum) && cells.len() < most {
        let Some(worst) = cells.pop() else { break };
        if worst.estimate.error <= f64::EPSILON * sum.value.abs() / most as f64 {
            cells.push(worst);
            break;
        }
        sum.value -= worst.estimate.value;
        sum.error -= worst.estimate.error;
        worst.refine(&f, |cell| {
            sum = sum + cell.estimate;
            cells.push(cell);
        });
    }
    // Summed again, since the running sum has accumulated rounding errors.
    cells.into_iter().map(|cell| cell.estimate).sum()
}

impl Cell {
    fn new(part: Part, f: impl Fn(usize, DVec3) -> f64) -> Cell {
        let at = |order| over_triangle(part.triangle, order, |point| f(part.function, point));
        Cell { part, order: Order::Four, estimate: Cell::estimate(at(Order::Two), at(Order::Four)) }
    }

    fn estimate(coarse: f64, fine: f64) -> Estimate {
        Estimate { value: fine, error: (fine - coarse).abs() }
    }

    fn refine(self, f: impl Fn(usize, DVec3) -> f64, mut put: impl FnMut(Cell)) {
        let Cell { part, order, estimate } = self;
        if part.smooth && order == Order::Four {
            let order = Order::Eight;
            let fine = over_triangle(part.triangle, order, |point| f(part.function, point));
            put(Cell { part, order, estimate: Cell::estimate(estimate.value, fine) });
            return;
        }
        for triangle in quarters(part.triangle) {
            put(Cell::new(Part { triangle, ..part }, &f));
        }
    }
}

/// A triangle split into four along the lines between the middles of its sides.
pub(crate) fn quarters([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    let (ab, bc, ca) = ((a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5);
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]]
}

impl Ord for Cell {
    fn cmp(&self, other: &Cell) -> Ordering {
        self.estimate.error.total_cmp(&other.estimate.error)
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Cell) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Cell) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    /// ∫ |x − y| over the triangle (0,0), (1,0), (0,1) is 1/6. Like the edge of
    /// a shadow, the crease is not aligned with any split.
    #[test]
    fn a_crease_is_integrated_to_its_tolerance() {
        let part = Part { triangle: UNIT, function: 0, smooth: false };
        let crease = |_: usize, p: DVec3| (p.x - 0.7 * p.y - 0.1).abs();
        let finest = integrate([part], Tolerance { absolute: 1e-9, relative: 0.0 }, crease);
        for absolute in [1e-3, 1e-5, 1e-7] {
            let coarse = integrate([part], Tolerance { absolute, relative: 0.0 }, crease);
            assert!(coarse.error <= absolute);
            assert!((coarse.value - finest.value).abs() <= absolute, "{coarse:?} {finest:?}");
        }
    }

    #[test]
    fn a_tolerance_that_cannot_be_reached_is_reported() {
        let part = Part { triangle: UNIT, function: 0, smooth: false };
        let jump = |_: usize, p: DVec3| f64::from(p.x > 1.0 / 3.0_f64.sqrt());
        let estimate = integrate([part], Tolerance { absolute: 1e-12, relative: 0.0 }, jump);
        assert!(estimate.error > 1e-12 && estimate.error < 1e-4, "{estimate:?}");
    }
}
