//! Where the rays of a bundle enter a block: [`Grid::enter`](crate::Grid::enter) for 64 rays at a time.

use fearless_simd::prelude::*;

use super::lattice::Lattice;
use super::rays::Rays;
use super::way::Way;

/// How rays enter a block.
#[derive(Default)]
pub(crate) struct Entry {
    /// Cells of the block in which rays enter it, and which do.
    pub(crate) cells: Vec<([u32; 3], u64)>,
    /// Rays, a bit each, by the cell of an axis at which they enter, for either axis of the side that
    /// they enter by.
    columns: [Vec<(u32, u64)>; 2],
}

/// Rays of a bundle that all go the same ways, and where from.
struct Comers<'a> {
    lattice: &'a Lattice<'a>,
    rays: &'a Rays,
    ways: [Way; 3],
}

impl Entry {
    /// Find the cells in which rays that all go the same `ways` enter a block from outside. Returns
    /// those that never do.
    #[inline(always)]
    pub(crate) fn find<S: Simd>(
        &mut self,
        simd: S,
        lattice: &Lattice,
        rays: &Rays,
        ways: [Way; 3],
        cast: u64,
    ) -> u64 {
        self.cells.clear();
        let Some(sides) = sides_ahead(lattice, ways) else { return cast };
        for axis in 0..3 {
            let Some(plane) = sides[axis] else { continue };
            // By this side enter those that cross it last.
            let mut through = cast;
            for other in (0..3).filter(|&other| other != axis) {
                if let Some(before) = sides[other] {
                    through &= lattice.crossed(simd, rays, (other, before), (axis, plane));
                }
            }
            if through != 0 {
                self.enter_by(simd, &Comers { lattice, rays, ways }, (axis, plane), through);
            }
        }
        self.cells.iter().fold(cast, |never, (_, rays)| never & !rays)
    }

    /// Find the cells of rays that complete their entry at a plane.
    #[inline(always)]
    fn enter_by<S: Simd>(&mut self, simd: S, comers: &Comers, side: (usize, u32), cast: u64) {
        let (axis, plane) = side;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let [columns, rows] = &mut self.columns;
        comers.part(simd, u, side, cast, columns);
        comers.part(simd, v, side, cast, rows);
        let mut cell = [0; 3];
        cell[axis] = if comers.ways[axis] == Way::Up { plane } else { plane - 1 };
        for &(i, in_column) in columns.iter() {
            for &(j, in_row) in rows.iter() {
                (cell[u], cell[v]) = (i, j);
                let rays = in_column & in_row;
                if rays != 0 && comers.lattice.block.contains(cell) {
                    self.cells.push((cell, rays));
                }
            }
        }
    }
}

impl Comers<'_> {
    /// Part rays by the cell of an axis that they have come to when they enter by a side.
    #[inline(always)]
    fn part<S: Simd>(
        &self,
        simd: S,
        axis: usize,
        side: (usize, u32),
        cast: u64,
        cells: &mut Vec<(u32, u64)>,
    ) {
        cells.clear();
        let start = self.lattice.start[axis];
        if self.ways[axis] == Way::Level {
            cells.push((start, cast));
            return;
        }
        let up = self.ways[axis] == Way::Up;
        // From the block's first cell on their way to its last; there is none past the grid's last.
        let (low, high) = (self.lattice.block.low[axis], self.lattice.block.high[axis]);
        let last = if up { self.lattice.grid.cells()[axis] - 1 } else { 0 };
        let (mut cell, end) =
            if up { (start.max(low), high - 1) } else { (start.min(high - 1), low) };
        let mut rest = cast;
        if cell != start {
            rest &= self.into(simd, axis, cell, side);
        }
        loop {
            let next = if up { cell + 1 } else { cell.saturating_sub(1) };
            let beyond = if cell == last { 0 } else { rest & self.into(simd, axis, next, side) };
            if rest != beyond {
                cells.push((cell, rest & !beyond));
            }
            if cell == end || beyond == 0 {
                return;
            }
            (cell, rest) = (next, beyond);
        }
    }

    /// The rays that have crossed into a cell of an axis when they enter by a side.
    #[inline(always)]
    fn into<S: Simd>(&self, simd: S, axis: usize, cell: u32, side: (usize, u32)) -> u64 {
        let plane = if self.ways[axis] == Way::Up { cell } else { cell + 1 };
        self.lattice.crossed(simd, self.rays, (axis, plane), side)
    }
}

/// The plane that rays have yet to cross into the block on each axis; `None` if on one of them they
/// lead away from it.
fn sides_ahead(lattice: &Lattice, ways: [Way; 3]) -> Option<[Option<u32>; 3]> {
    let mut sides = [None; 3];
    for axis in 0..3 {
        let (low, high) = (lattice.block.low[axis], lattice.block.high[axis]);
        let start = lattice.start[axis];
        sides[axis] = match ways[axis] {
            _ if (low..high).contains(&start) => None,
            Way::Up if start < low => Some(low),
            Way::Down if start >= high => Some(high),
            _ => return None,
        };
    }
    Some(sides)
}
