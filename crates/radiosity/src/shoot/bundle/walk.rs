//! The walk of a bundle's rays through the grid, those in the same cell together: where they end, and
//! what the virtual processor is charged for. It is [`Passage`](crate::grid::Passage) for 64 rays at
//! a time, without testing a polygon.

use fearless_simd::prelude::*;

use super::entry::Entry;
use super::lattice::Lattice;
use super::nearest::Nearest;
use super::rays::{CHUNKS, LANES, Rays, of_chunk};
use super::way::Way;
use crate::mesh::Side;

/// Walks through one block from one source.
pub(crate) struct Walk<'a> {
    lattice: Lattice<'a>,
    entry: Entry,
    here: Vec<Group>,
    /// Where groups go from here; rays that come to one cell from several go on as one group.
    next: Vec<Group>,
}

/// Rays of a bundle, a bit each, that are in the same cell.
#[derive(Clone, Copy)]
struct Group {
    cell: u32,
    /// The plane ahead of them on each axis, by its place among all.
    ahead: [u32; 3],
    rays: u64,
}

/// What becomes of a group on each axis when it crosses the plane ahead, for rays that go the same way
/// on all.
struct Course {
    ways: [Way; 3],
    /// To the next plane.
    step: [i32; 3],
    /// To the next cell.
    stride: [i32; 3],
    /// The plane at the end of the block.
    end: [u32; 3],
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
    pub(crate) fn new(lattice: Lattice<'a>) -> Walk<'a> {
        Walk { lattice, entry: Entry::default(), here: Vec::new(), next: Vec::new() }
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
            let (ways, alike) = Way::of_first(rays, rest);
            rest &= !alike;
            let course = Course::new(&self.lattice, ways);
            self.enter(simd, rays, &course, alike, &mut walked);
            while !self.here.is_empty() {
                for group in 0..self.here.len() {
                    let group = self.here[group];
                    let ahead = group.ahead.map(|plane| self.lattice.planes[plane as usize]);
                    let crossings = next_crossings(simd, rays, nearest, group.rays, ahead);
                    self.step(&course, group, crossings, found, &mut walked);
                }
                self.here.clear();
                std::mem::swap(&mut self.here, &mut self.next);
            }
        }
        walked
    }

    /// Put rays into the cells in which their walk starts.
    #[inline(always)]
    fn enter<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        course: &Course,
        cast: u64,
        walked: &mut Walked,
    ) {
        let Walk { lattice, entry, here, .. } = self;
        let mut start = |cell: [u32; 3], rays: u64| {
            let (ahead, cell) = (lattice.ahead(course.ways, cell), lattice.grid.index(cell) as u32);
            here.push(Group { cell, ahead, rays });
        };
        if lattice.block.contains(lattice.start) {
            start(lattice.start, cast);
            return;
        }
        let never = entry.find(simd, lattice, rays, course.ways, cast);
        entry.cells.iter().for_each(|&(cell, rays)| start(cell, rays));
        if never != 0 {
            let side = lattice.block.side_towards(lattice.start, course.ways[0] == Way::Up);
            walked.left[side.index()] |= never;
        }
    }

    /// Go on from one cell.
    #[inline(always)]
    fn step(
        &mut self,
        course: &Course,
        group: Group,
        [there, x, y]: [u64; 3],
        found: u64,
        walked: &mut Walked,
    ) {
        let count = u64::from(group.rays.count_ones());
        walked.steps += count;
        walked.tests += count * self.lattice.grid.polygons_in(group.cell);
        let ended = there & group.rays & found;
        walked.ended |= ended;
        let going = group.rays & !ended;
        for (axis, crossing) in [x, y & !x, !x & !y].into_iter().enumerate() {
            let crossing = Group { rays: going & crossing, ..group };
            if crossing.rays != 0 {
                self.cross(course, axis, crossing, walked);
            }
        }
    }

    /// Take rays over the plane ahead on an axis, to the next cell or out of the block.
    #[inline(always)]
    fn cross(&mut self, course: &Course, axis: usize, mut group: Group, walked: &mut Walked) {
        if group.ahead[axis] == course.end[axis] {
            let side = Side { axis, upper: course.ways[axis] == Way::Up };
            walked.left[side.index()] |= group.rays;
            return;
        }
        group.ahead[axis] = group.ahead[axis].wrapping_add_signed(course.step[axis]);
        group.cell = group.cell.wrapping_add_signed(course.stride[axis]);
        match self.next.iter_mut().find(|other| other.cell == group.cell) {
            Some(other) => other.rays |= group.rays,
            None => self.next.push(group),
        }
    }
}

impl Course {
    fn new(lattice: &Lattice, ways: [Way; 3]) -> Course {
        let [nx, ny, _] = lattice.grid.cells().map(|n| n as i32);
        let mut course = Course { ways, step: [0; 3], stride: [1, nx, nx * ny], end: [0; 3] };
        for (axis, way) in ways.into_iter().enumerate() {
            let (step, end) = match way {
                Way::Down => (-1, lattice.block.low[axis]),
                Way::Level => (0, 0),
                Way::Up => (1, lattice.block.high[axis]),
            };
            course.step[axis] = step;
            course.stride[axis] *= step;
            course.end[axis] = lattice.first[axis] + end;
        }
        course
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
