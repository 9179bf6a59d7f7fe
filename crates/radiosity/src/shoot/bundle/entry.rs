//! Finds the cells in which the rays of a bundle enter a block, as
//! [`Grid::enter`](crate::Grid::enter).

use fearless_simd::prelude::*;

use super::grid_view::GridView;
use super::heading::Heading;
use super::rays::Rays;

/// The cells in which rays enter a block.
#[derive(Default)]
pub(crate) struct Entry {
    /// Each cell with the rays that enter in it.
    pub(crate) cells: Vec<([u32; 3], u64)>,
    /// Working memory: rays by the cell in which they enter, for both axes of a side.
    columns: [Vec<(u32, u64)>; 2],
}

/// Rays with the same headings outside a block.
struct Outside<'a> {
    view: &'a GridView<'a>,
    rays: &'a Rays,
    headings: [Heading; 3],
}

impl Entry {
    /// Finds where rays with the same headings enter a block. Returns those that never do.
    #[inline(always)]
    pub(crate) fn find<S: Simd>(
        &mut self,
        simd: S,
        view: &GridView,
        rays: &Rays,
        headings: [Heading; 3],
        cast: u64,
    ) -> u64 {
        self.cells.clear();
        let Some(sides) = sides_ahead(view, headings) else { return cast };
        for axis in 0..3 {
            let Some(plane) = sides[axis] else { continue };
            // Rays enter through the side that they cross last.
            let mut through = cast;
            for other in (0..3).filter(|&other| other != axis) {
                if let Some(before) = sides[other] {
                    through &= view.crossed(simd, rays, (other, before), (axis, plane));
                }
            }
            if through != 0 {
                self.enter_through(simd, &Outside { view, rays, headings }, (axis, plane), through);
            }
        }
        self.cells.iter().fold(cast, |never, (_, rays)| never & !rays)
    }

    /// Finds the cells of the rays that enter through a side, given by its axis and plane.
    #[inline(always)]
    fn enter_through<S: Simd>(
        &mut self,
        simd: S,
        outside: &Outside,
        side: (usize, u32),
        cast: u64,
    ) {
        let (axis, plane) = side;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let [columns, rows] = &mut self.columns;
        outside.divide(simd, u, side, cast, columns);
        outside.divide(simd, v, side, cast, rows);
        let mut cell = [0; 3];
        cell[axis] = if outside.headings[axis] == Heading::Up { plane } else { plane - 1 };
        for &(i, in_column) in columns.iter() {
            for &(j, in_row) in rows.iter() {
                (cell[u], cell[v]) = (i, j);
                let rays = in_column & in_row;
                if rays != 0 && outside.view.block.contains(cell) {
                    self.cells.push((cell, rays));
                }
            }
        }
    }
}

impl Outside<'_> {
    /// Divides rays by the cell that they have reached on an axis when they enter through a side.
    #[inline(always)]
    fn divide<S: Simd>(
        &self,
        simd: S,
        axis: usize,
        side: (usize, u32),
        cast: u64,
        cells: &mut Vec<(u32, u64)>,
    ) {
        cells.clear();
        let start = self.view.start[axis];
        if self.headings[axis] == Heading::Level {
            cells.push((start, cast));
            return;
        }
        let up = self.headings[axis] == Heading::Up;
        // From the first reachable cell of the block to the last. The grid ends at `last`.
        let (low, high) = (self.view.block.low[axis], self.view.block.high[axis]);
        let last = if up { self.view.grid.cells()[axis] - 1 } else { 0 };
        let (mut cell, end) =
            if up { (start.max(low), high - 1) } else { (start.min(high - 1), low) };
        let mut rest = cast;
        if cell != start {
            rest &= self.reached(simd, axis, cell, side);
        }
        loop {
            let next = if up { cell + 1 } else { cell.saturating_sub(1) };
            let beyond = if cell == last { 0 } else { rest & self.reached(simd, axis, next, side) };
            if rest != beyond {
                cells.push((cell, rest & !beyond));
            }
            if cell == end || beyond == 0 {
                return;
            }
            (cell, rest) = (next, beyond);
        }
    }

    /// The rays that have reached a cell on an axis when they enter through a side.
    #[inline(always)]
    fn reached<S: Simd>(&self, simd: S, axis: usize, cell: u32, side: (usize, u32)) -> u64 {
        let plane = if self.headings[axis] == Heading::Up { cell } else { cell + 1 };
        self.view.crossed(simd, self.rays, (axis, plane), side)
    }
}

/// The plane that rays must cross on each axis to get into the block, where they must cross one.
/// `None` if on one axis they run away from the block.
fn sides_ahead(view: &GridView, headings: [Heading; 3]) -> Option<[Option<u32>; 3]> {
    let mut sides = [None; 3];
    for axis in 0..3 {
        let (low, high) = (view.block.low[axis], view.block.high[axis]);
        let start = view.start[axis];
        sides[axis] = match headings[axis] {
            _ if (low..high).contains(&start) => None,
            Heading::Up if start < low => Some(low),
            Heading::Down if start >= high => Some(high),
            _ => return None,
        };
    }
    Some(sides)
}
