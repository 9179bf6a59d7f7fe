//! The walk of the rays of a bundle through the grid: counts the operations of the simulated
//! processor and finds where rays leave the block.
//!
//! It does what [`Passage`](crate::Passage) does, for 64 rays at a time: rays in the same cell go
//! together. Polygons are counted, not tested: hits are known already.

use fearless_simd::prelude::*;

use super::entry::Entry;
use super::grid_view::GridView;
use super::heading::Heading;
use super::nearest::Nearest;
use super::rays::{CHUNKS, LANES, Rays, of_chunk};
use crate::mesh::Side;

/// Walks rays of one emitter through one block.
pub(crate) struct Walk<'a> {
    view: GridView<'a>,
    entry: Entry,
    /// Groups that still have to move in this step.
    here: Vec<Group>,
    /// Groups after the next step. Rays that reach the same cell become one group.
    next: Vec<Group>,
}

/// Rays of a bundle, one bit each, that are in the same cell.
#[derive(Clone, Copy)]
struct Group {
    cell: u32,
    /// The next plane on each axis: its index in [`GridView::planes`].
    ahead: [u32; 3],
    rays: u64,
}

/// How a group moves when it crosses the next plane of an axis, for rays with the same headings.
struct Course {
    headings: [Heading; 3],
    /// Added to the index of the plane.
    step: [i32; 3],
    /// Added to the index of the cell.
    stride: [i32; 3],
    /// Index of the plane at the end of the block.
    end: [u32; 3],
}

/// Result of a walk.
#[derive(Default)]
pub(crate) struct Walked {
    /// Number of cells passed, over all rays.
    pub(crate) steps: u64,
    /// Number of polygons in these cells.
    pub(crate) tests: u64,
    /// Rays that end at their hit.
    pub(crate) ended: u64,
    /// Rays that leave the block, by side.
    pub(crate) left: [u64; 6],
}

impl<'a> Walk<'a> {
    pub(crate) fn new(view: GridView<'a>) -> Walk<'a> {
        Walk { view, entry: Entry::default(), here: Vec::new(), next: Vec::new() }
    }

    /// Walks the rays `cast` of a bundle, each to its hit or out of the block.
    #[inline(always)]
    pub(crate) fn run<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        nearest: &Nearest,
        cast: u64,
    ) -> Walked {
        let (found, rounding) = (nearest.found(), self.view.grid.rounding);
        let mut walked = Walked::default();
        let mut rest = cast;
        while rest != 0 {
            // Rays with the same headings go together. Usually these are all of them.
            let (headings, alike) = Heading::of_first(rays, rest);
            rest &= !alike;
            let course = Course::new(&self.view, headings);
            self.enter(simd, rays, &course, alike, &mut walked);
            while !self.here.is_empty() {
                for group in 0..self.here.len() {
                    let group = self.here[group];
                    let ahead = group.ahead.map(|plane| self.view.planes[plane as usize]);
                    let crossings =
                        next_crossings(simd, rays, nearest, group.rays, ahead, rounding);
                    self.step(&course, group, crossings, found, &mut walked);
                }
                self.here.clear();
                std::mem::swap(&mut self.here, &mut self.next);
            }
        }
        walked
    }

    /// Puts rays into the cells in which their walk starts.
    #[inline(always)]
    fn enter<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        course: &Course,
        cast: u64,
        walked: &mut Walked,
    ) {
        let Walk { view, entry, here, .. } = self;
        let mut start = |cell: [u32; 3], rays: u64| {
            let (ahead, cell) = (view.ahead(course.headings, cell), view.grid.index(cell) as u32);
            here.push(Group { cell, ahead, rays });
        };
        if view.block.contains(view.start) {
            start(view.start, cast);
            return;
        }
        let never = entry.find(simd, view, rays, course.headings, cast);
        entry.cells.iter().for_each(|&(cell, rays)| start(cell, rays));
        if never != 0 {
            let side = view.block.side_towards(view.start, course.headings[0] == Heading::Up);
            walked.left[side.index()] |= never;
        }
    }

    /// Moves a group on from its cell.
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
        walked.tests += count * self.view.grid.polygons_in(group.cell);
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

    /// Moves rays across the next plane of an axis, to the next cell or out of the block.
    #[inline(always)]
    fn cross(&mut self, course: &Course, axis: usize, mut group: Group, walked: &mut Walked) {
        if group.ahead[axis] == course.end[axis] {
            let side = Side { axis, upper: course.headings[axis] == Heading::Up };
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
    fn new(view: &GridView, headings: [Heading; 3]) -> Course {
        let [nx, ny, _] = view.grid.cells().map(|n| n as i32);
        let mut course = Course { headings, step: [0; 3], stride: [1, nx, nx * ny], end: [0; 3] };
        for (axis, heading) in headings.into_iter().enumerate() {
            let (step, end) = match heading {
                Heading::Down => (-1, view.block.low[axis]),
                Heading::Level => (0, 0),
                Heading::Up => (1, view.block.high[axis]),
            };
            course.step[axis] = step;
            course.stride[axis] *= step;
            course.end[axis] = view.first[axis] + end;
        }
        course
    }
}

/// What rays in a cell do next, with the next planes at coordinates `ahead` from the emitter: rays
/// that reach their hit first, or within `rounding`, rays that cross x first, and rays that cross y before z. Of equal
/// crossings, the lower axis is first.
#[inline(always)]
fn next_crossings<S: Simd>(
    simd: S,
    rays: &Rays,
    nearest: &Nearest,
    group: u64,
    ahead: [f64; 3],
    rounding: f64,
) -> [u64; 3] {
    let mut found = [0; 3];
    for chunk in (0..CHUNKS).filter(|&chunk| of_chunk(group, chunk) != 0) {
        let x = ahead[0] * rays.inverse[0][chunk].load(simd);
        let y = ahead[1] * rays.inverse[1][chunk].load(simd);
        let z = ahead[2] * rays.inverse[2][chunk].load(simd);
        let y_or_z = y.min(z);
        let first = x.min(y_or_z);
        let there = nearest.distance[chunk].load(simd).simd_le(first + rounding);
        for (found, mask) in found.iter_mut().zip([there, x.simd_le(y_or_z), y.simd_le(z)]) {
            *found |= mask.to_bitmask() << (chunk * LANES);
        }
    }
    found
}
