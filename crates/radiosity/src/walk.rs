//! The walk of a bundle's rays through the grid, those in the same cell together: where they end, and
//! what the virtual processor is charged for. It is [`Passage`](crate::grid::Passage) for 64 rays at
//! a time, without testing a polygon.

use fearless_simd::prelude::*;
use glam::DVec3;

use crate::bundle::{CHUNKS, LANES, Rays, of_chunk};
use crate::grid::{Block, Grid, Side};
use crate::nearest::Nearest;

/// Walks through one block from one source.
pub(crate) struct Walk<'a> {
    grid: &'a Grid,
    block: Block,
    /// The cell of the source.
    start: [u32; 3],
    /// Distance from the source to each plane of the grid, along its axis.
    planes: [Vec<f64>; 3],
    here: Vec<Group>,
    /// Where groups go from here; rays that come to one cell from several go on as one group.
    ahead: Vec<Group>,
    /// Room for the columns of cells that rays enter, along either axis of the side they come by.
    columns: [Vec<Column>; 2],
}

/// Rays of a bundle, a bit each, that are in the same cell.
#[derive(Clone, Copy)]
struct Group {
    cell: [u32; 3],
    rays: u64,
}

/// Rays of a bundle that are at the same cell of an axis.
type Column = (u32, u64);

/// Which way rays go along an axis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    Down,
    Level,
    Up,
}

/// What came of a walk.
#[derive(Default)]
pub(crate) struct Walked {
    /// Cells come through, over all rays.
    pub(crate) steps: u64,
    /// Polygons in them.
    pub(crate) tests: u64,
    /// Rays that end on their hit.
    pub(crate) ended: u64,
    /// Rays that leave the block, by side.
    pub(crate) left: [u64; 6],
}

impl<'a> Walk<'a> {
    pub(crate) fn new(grid: &'a Grid, block: Block, origin: DVec3) -> Walk<'a> {
        let relative =
            |axis: usize| grid.planes[axis].iter().map(|plane| plane - origin[axis]).collect();
        Walk {
            grid,
            block,
            start: grid.cell_of(origin),
            planes: std::array::from_fn(relative),
            here: Vec::new(),
            ahead: Vec::new(),
            columns: [Vec::new(), Vec::new()],
        }
    }

    /// Walk those rays of a bundle that are `cast`, each to its hit or out of the block.
    #[inline(always)]
    pub(crate) fn run<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        nearest: &Nearest,
        cast: u64,
    ) -> Walked {
        let found = nearest.found();
        let mut walked = Walked::default();
        let mut rest = cast;
        while rest != 0 {
            // Those that go the same way on every axis go together: mostly all of them.
            let first = rest & rest.wrapping_neg();
            let ways = std::array::from_fn(|axis| Way::of(rays, axis, first));
            let alike = (0..3).fold(rest, |alike, axis| alike & ways[axis].all(rays, axis));
            rest &= !alike;
            self.enter(simd, rays, ways, alike, &mut walked);
            while !self.here.is_empty() {
                for group in 0..self.here.len() {
                    let Group { cell, rays: here } = self.here[group];
                    let ahead = self.planes_ahead(ways, cell);
                    let crossings = next_crossings(simd, rays, nearest, here, ahead);
                    self.step(ways, self.here[group], crossings, found, &mut walked);
                }
                self.here.clear();
                std::mem::swap(&mut self.here, &mut self.ahead);
            }
        }
        walked
    }

    /// The planes ahead of rays in a cell.
    #[inline(always)]
    fn planes_ahead(&self, ways: [Way; 3], cell: [u32; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| match ways[axis] {
            Way::Down => self.planes[axis][cell[axis] as usize],
            Way::Level => f64::INFINITY,
            Way::Up => self.planes[axis][cell[axis] as usize + 1],
        })
    }

    /// Go on from one cell.
    #[inline(always)]
    fn step(
        &mut self,
        ways: [Way; 3],
        group: Group,
        [there, x, y]: [u64; 3],
        found: u64,
        walked: &mut Walked,
    ) {
        let count = u64::from(group.rays.count_ones());
        walked.steps += count;
        walked.tests += count * self.grid.polygons(group.cell).len() as u64;
        let ended = there & group.rays & found;
        walked.ended |= ended;
        let going = group.rays & !ended;
        for (axis, crossing) in [x, y & !x, !x & !y].into_iter().enumerate() {
            let crossing = Group { rays: going & crossing, ..group };
            if crossing.rays != 0 {
                self.cross(axis, ways[axis] == Way::Up, crossing, walked);
            }
        }
    }

    /// Take rays over a side of their cell, or out of the block.
    #[inline]
    fn cross(&mut self, axis: usize, upper: bool, mut group: Group, walked: &mut Walked) {
        let cell = &mut group.cell[axis];
        let end = if upper { self.block.high[axis] - 1 } else { self.block.low[axis] };
        if *cell == end {
            walked.left[Side { axis, upper }.index()] |= group.rays;
            return;
        }
        *cell = if upper { *cell + 1 } else { *cell - 1 };
        match self.ahead.iter_mut().find(|other| other.cell == group.cell) {
            Some(other) => other.rays |= group.rays,
            None => self.ahead.push(group),
        }
    }

    /// Put rays into the cells in which they enter the block, as [`Grid::enter`] does.
    #[inline(always)]
    fn enter<S: Simd>(&mut self, simd: S, rays: &Rays, ways: [Way; 3], cast: u64, walked: &mut Walked) {
        if self.block.contains(self.start) {
            self.here.push(Group { cell: self.start, rays: cast });
            return;
        }
        let mut never = cast;
        if let Some(sides) = self.sides_ahead(ways) {
            for axis in 0..3 {
                let Some(plane) = sides[axis] else { continue };
                // By this side enter those that cross it last.
                let mut through = cast;
                for other in (0..3).filter(|&other| other != axis) {
                    if let Some(before) = sides[other] {
                        through &= self.crossed(simd, rays, (other, before), (axis, plane));
                    }
                }
                if through != 0 {
                    never &= !self.enter_by(simd, rays, ways, (axis, plane), through);
                }
            }
        }
        if never != 0 {
            let side = self.block.side_towards(self.start, ways[0] == Way::Up);
            walked.left[side.index()] |= never;
        }
    }

    /// The plane that rays have yet to cross into the block on each axis; `None` if on one of them
    /// they lead away from it.
    fn sides_ahead(&self, ways: [Way; 3]) -> Option<[Option<u32>; 3]> {
        let mut sides = [None; 3];
        for axis in 0..3 {
            let (low, high) = (self.block.low[axis], self.block.high[axis]);
            sides[axis] = match ways[axis] {
                _ if (low..high).contains(&self.start[axis]) => None,
                Way::Up if self.start[axis] < low => Some(low),
                Way::Down if self.start[axis] >= high => Some(high),
                _ => return None,
            };
        }
        Some(sides)
    }

    /// Put rays that complete their entry at a plane into their cells behind it; those that were in
    /// the block's part of it.
    #[inline(always)]
    fn enter_by<S: Simd>(&mut self, simd: S, rays: &Rays, ways: [Way; 3], entry: (usize, u32), cast: u64) -> u64 {
        let (axis, plane) = entry;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut columns = std::mem::take(&mut self.columns);
        self.columns_along(simd, u, rays, ways[u], entry, cast, &mut columns[0]);
        self.columns_along(simd, v, rays, ways[v], entry, cast, &mut columns[1]);
        let mut entered = 0;
        let mut cell = [0; 3];
        cell[axis] = if ways[axis] == Way::Up { plane } else { plane - 1 };
        for &(i, in_column) in &columns[0] {
            for &(j, in_row) in &columns[1] {
                (cell[u], cell[v]) = (i, j);
                let rays = in_column & in_row;
                if rays != 0 && self.block.contains(cell) {
                    self.here.push(Group { cell, rays });
                    entered |= rays;
                }
            }
        }
        self.columns = columns;
        entered
    }

    /// The cells of an axis at which rays are when they cross the plane `entry` of another axis.
    #[inline(always)]
    fn columns_along<S: Simd>(
        &self,
        simd: S,
        axis: usize,
        rays: &Rays,
        way: Way,
        entry: (usize, u32),
        cast: u64,
        columns: &mut Vec<Column>,
    ) {
        columns.clear();
        let start = self.start[axis];
        let (low, high) = (self.block.low[axis], self.block.high[axis]);
        if way == Way::Level {
            columns.push((start, cast));
            return;
        }
        let up = way == Way::Up;
        // Those that have come as far as a cell.
        let come_to = |cell: u32, among: u64| match cell == start {
            true => among,
            false => among & self.crossed(simd, rays, (axis, cell + u32::from(!up)), entry),
        };
        // From the block's first cell on their way to its last; past the grid's last there is none.
        let cells = self.grid.cells()[axis];
        let (mut cell, end, last) =
            if up { (start.max(low), high - 1, cells - 1) } else { (start.min(high - 1), low, 0) };
        let mut rest = come_to(cell, cast);
        loop {
            let next = if up { cell + 1 } else { cell.saturating_sub(1) };
            let beyond = if cell == last { 0 } else { come_to(next, rest) };
            columns.push((cell, rest & !beyond));
            if cell == end || beyond == 0 {
                return;
            }
            (cell, rest) = (next, beyond);
        }
    }

    /// The rays whose crossing of one plane comes before that of another, each an axis and a number.
    #[inline(always)]
    fn crossed<S: Simd>(&self, simd: S, rays: &Rays, first: (usize, u32), second: (usize, u32)) -> u64 {
        let distance = |(axis, plane): (usize, u32)| (axis, self.planes[axis][plane as usize]);
        crossed(simd, rays, distance(first), distance(second))
    }
}

impl Way {
    /// The way of the ray in `bit`.
    fn of(rays: &Rays, axis: usize, bit: u64) -> Way {
        if rays.level[axis] & bit != 0 {
            Way::Level
        } else if rays.up[axis] & bit != 0 {
            Way::Up
        } else {
            Way::Down
        }
    }

    /// All rays that go this way.
    fn all(self, rays: &Rays, axis: usize) -> u64 {
        match self {
            Way::Down => !rays.up[axis] & !rays.level[axis],
            Way::Level => rays.level[axis],
            Way::Up => rays.up[axis],
        }
    }
}

/// Of rays in a cell, the planes ahead of it at these distances along each axis: those whose hit is
/// no farther than the nearest crossing; those that cross the plane of x first; of the others, but not
/// of them alone, those that cross that of y first. Of equal crossings that of the lower axis is first.
#[inline(always)]
fn next_crossings<S: Simd>(
    simd: S,
    rays: &Rays,
    nearest: &Nearest,
    group: u64,
    ahead: [f64; 3],
) -> [u64; 3] {
    let mut found = [0; 3];
    for chunk in (0..CHUNKS).filter(|&chunk| of_chunk(group, chunk) != 0) {
        let x = ahead[0] * rays.inverse[0][chunk].load(simd);
        let y = ahead[1] * rays.inverse[1][chunk].load(simd);
        let z = ahead[2] * rays.inverse[2][chunk].load(simd);
        let y_or_z = y.min(z);
        let first = x.min(y_or_z);
        let there = nearest.distance[chunk].load(simd).simd_le(first);
        for (found, mask) in found.iter_mut().zip([there, x.simd_le(y_or_z), y.simd_le(z)]) {
            *found |= mask.to_bitmask() << (chunk * LANES);
        }
    }
    found
}

/// The rays whose crossing of one plane, given by its axis and its distance along it, comes before
/// that of another: sorted by distance, then by axis.
#[inline(always)]
fn crossed<S: Simd>(simd: S, rays: &Rays, first: (usize, f64), second: (usize, f64)) -> u64 {
    let (mut less, mut equal) = (0, 0);
    for chunk in 0..CHUNKS {
        let a = first.1 * rays.inverse[first.0][chunk].load(simd);
        let b = second.1 * rays.inverse[second.0][chunk].load(simd);
        less |= a.simd_lt(b).to_bitmask() << (chunk * LANES);
        equal |= a.simd_eq(b).to_bitmask() << (chunk * LANES);
    }
    less | if first.0 < second.0 { equal } else { 0 }
}
