//! Walks of several rays from one source through the grid, side by side, to count what the virtual
//! processor does: [`Passage`](crate::grid::Passage) without testing a polygon.

#![allow(clippy::needless_range_loop, reason = "plain loops become vector instructions")]

use glam::DVec3;
use multiversion::multiversion;

use crate::facets::Ray;
use crate::grid::{Block, Grid, Side};

/// Rays done at a time.
pub(crate) const LANES: usize = 8;

type Lanes = [f64; LANES];
type Whole = [i64; LANES];

/// Rays on their way, each in its own cell.
pub(crate) struct Walks<'a> {
    grid: &'a Grid,
    block: Block,
    /// Distance from the origin to each plane, axis after axis; one more at either end of an axis
    /// stands for the plane that a ray which leaves the grid would cross next.
    planes: Vec<f64>,
    /// Where the planes of each axis start.
    first: [i64; 3],
    /// By how much the number of a cell changes at a step up each axis.
    stride: [i64; 3],
    state: State,
}

/// What each ray is about to do, and what it did.
#[derive(Default)]
struct State {
    walking: [u64; LANES],
    /// Where to stop.
    distance: Lanes,
    /// Cell.
    at: Whole,
    /// By axis: distance of the next crossing, the plane after it, cells left before the block ends.
    next: [Lanes; 3],
    plane: [Whole; 3],
    left: [Whole; 3],
    /// By axis: 1 / direction, and by how much plane and cell change at a crossing.
    inverse: [Lanes; 3],
    step: [Whole; 3],
    stride: [Whole; 3],
    steps: [u64; LANES],
    tests: [u64; LANES],
    /// The axis of the crossing that left the block; 3 while none did.
    out: [u64; LANES],
}

/// Directions of several rays and how far each goes.
pub(crate) struct Aim<'a> {
    pub(crate) direction: [&'a Lanes; 3],
    pub(crate) inverse: [&'a Lanes; 3],
    pub(crate) distance: Lanes,
}

/// What lies around a cell along one axis.
struct Ahead {
    /// Distances of the planes below and above.
    planes: [f64; 2],
    /// The place of the plane below.
    place: i64,
    /// Cells left before the block ends, downwards and upwards.
    left: [i64; 2],
    /// By how much the cell changes at a crossing upwards.
    stride: i64,
}

/// What a walk counted.
pub(crate) struct Counted {
    pub(crate) steps: u64,
    pub(crate) tests: u64,
    /// The side by which the ray left the block before it had gone its distance.
    pub(crate) side: Option<Side>,
}

impl<'a> Walks<'a> {
    /// Walks through a block from a source.
    pub(crate) fn new(grid: &'a Grid, block: Block, origin: DVec3) -> Walks<'a> {
        let mut planes = Vec::new();
        let mut first = [0; 3];
        for axis in 0..3 {
            planes.push(f64::INFINITY);
            first[axis] = planes.len() as i64;
            planes.extend(grid.planes[axis].iter().map(|plane| plane - origin[axis]));
            planes.push(f64::INFINITY);
        }
        let [nx, ny, _] = grid.cells().map(i64::from);
        let stride = [1, nx, nx * ny];
        Walks { grid, block, planes, first, stride, state: State::default() }
    }

    /// Forget the walks of before.
    pub(crate) fn clear(&mut self) {
        self.state = State::default();
    }

    /// Start walks in the cell of the source itself, for those lanes that are `cast`; each goes as far
    /// as its `distance`.
    pub(crate) fn start_together(&mut self, cell: [u32; 3], aim: &Aim, cast: u64) {
        let ahead = std::array::from_fn(|axis| {
            let (low, high) = (self.block.low[axis], self.block.high[axis]);
            let place = self.first[axis] + i64::from(cell[axis]);
            Ahead {
                planes: [place, place + 1].map(|plane| self.planes[plane as usize]),
                place,
                left: [cell[axis] - low, high - 1 - cell[axis]].map(i64::from),
                stride: self.stride[axis],
            }
        });
        self.state.at = [self.grid.index(cell) as i64; LANES];
        start_together(&mut self.state, &ahead, aim, cast);
    }

    /// Start a walk where a ray enters the block: in `cell`, its next crossings at `next`.
    #[inline]
    pub(crate) fn start(
        &mut self,
        lane: usize,
        ray: &Ray,
        cell: [u32; 3],
        next: [f64; 3],
        distance: f64,
    ) {
        let state = &mut self.state;
        state.walking[lane] = u64::MAX;
        state.distance[lane] = distance;
        state.at[lane] = self.grid.index(cell) as i64;
        state.out[lane] = 3;
        for axis in 0..3 {
            let upper = ray.direction[axis] > 0.0;
            let step = if upper { 1 } else { -1 };
            let (low, high) = (self.block.low[axis], self.block.high[axis]);
            let left = if upper { high - 1 - cell[axis] } else { cell[axis] - low };
            state.next[axis][lane] = next[axis];
            state.plane[axis][lane] =
                self.first[axis] + i64::from(cell[axis]) + i64::from(upper) + step;
            state.left[axis][lane] = i64::from(left);
            state.inverse[axis][lane] = ray.inverse[axis];
            state.step[axis][lane] = step;
            state.stride[axis][lane] = step * self.stride[axis];
        }
    }

    /// Walk all to their ends.
    pub(crate) fn run(&mut self) {
        run(&mut self.state, &self.planes, &self.grid.starts);
    }

    /// What a walk counted.
    #[inline]
    pub(crate) fn counted(&self, lane: usize) -> Counted {
        let state = &self.state;
        let axis = state.out[lane] as usize;
        let side = (axis < 3).then(|| Side { axis, upper: state.step[axis][lane] > 0 });
        Counted { steps: state.steps[lane], tests: state.tests[lane], side }
    }
}

/// Of three values the one whose mask is all ones, the other masks being zero.
macro_rules! choose {
    ($masks:expr, $l:expr; $x:expr, $y:expr, $z:expr) => {
        ($masks[0][$l] & $x) | ($masks[1][$l] & $y) | ($masks[2][$l] & $z)
    };
}

/// Take the chosen axis on to its next crossing.
macro_rules! advance {
    ($state:expr, $axis:literal, $chosen:expr, $ahead:expr, $at:expr) => {
        let (mut next, mut plane) = ($state.next[$axis], $state.plane[$axis]);
        let mut left = $state.left[$axis];
        let (inverse, step) = ($state.inverse[$axis], $state.step[$axis]);
        let (stride, chosen) = ($state.stride[$axis], $chosen[$axis]);
        for l in 0..LANES {
            let crossing = ($ahead[l] * inverse[l]).to_bits();
            next[l] = f64::from_bits((crossing & chosen[l]) | (next[l].to_bits() & !chosen[l]));
        }
        for l in 0..LANES {
            plane[l] += step[l] & chosen[l] as i64;
            left[l] -= (chosen[l] & 1) as i64;
            $at[l] += stride[l] & chosen[l] as i64;
        }
        $state.next[$axis] = next;
        $state.plane[$axis] = plane;
        $state.left[$axis] = left;
    };
}

// Plain loops over arrays of known length, for the sake of vector instructions.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn start_together(state: &mut State, ahead: &[Ahead; 3], aim: &Aim<'_>, cast: u64) {
    for l in 0..LANES {
        state.walking[l] = (cast >> l & 1).wrapping_neg();
    }
    state.distance = aim.distance;
    state.out = [3; LANES];
    state.steps = [0; LANES];
    state.tests = [0; LANES];
    for axis in 0..3 {
        let Ahead { planes, place, left, stride } = &ahead[axis];
        let (direction, inverse) = (aim.direction[axis], aim.inverse[axis]);
        let mut next = [0.0f64; LANES];
        for l in 0..LANES {
            let plane = if direction[l] > 0.0 { planes[1] } else { planes[0] };
            let crossing = plane * inverse[l];
            next[l] = if direction[l] == 0.0 { f64::INFINITY } else { crossing };
        }
        state.next[axis] = next;
        state.inverse[axis] = *inverse;
        let (mut step, mut strides) = ([0; LANES], [0; LANES]);
        let (mut lefts, mut after) = ([0; LANES], [0; LANES]);
        for l in 0..LANES {
            let upper = direction[l] > 0.0;
            step[l] = if upper { 1 } else { -1 };
            strides[l] = if upper { *stride } else { -*stride };
            lefts[l] = if upper { left[1] } else { left[0] };
            after[l] = if upper { *place + 2 } else { *place - 1 };
        }
        (state.step[axis], state.stride[axis]) = (step, strides);
        (state.left[axis], state.plane[axis]) = (lefts, after);
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn run(state: &mut State, planes: &[f64], starts: &[u32]) {
    let (mut walking, mut out, mut at) = (state.walking, state.out, state.at);
    let (mut steps, mut tests) = (state.steps, state.tests);
    let distance = state.distance;
    while walking != [0; LANES] {
        for l in 0..LANES {
            let cell = at[l] as usize;
            tests[l] += u64::from(starts[cell + 1] - starts[cell]) & walking[l];
        }
        let mut chosen = [[0u64; LANES]; 3];
        let mut after = [0u64; LANES];
        let [x, y, z] = state.next;
        for l in 0..LANES {
            // The nearest crossing; of equal ones that of the lower axis.
            chosen[0][l] = u64::from((x[l] <= y[l]) & (x[l] <= z[l])).wrapping_neg();
            chosen[1][l] = u64::from(y[l] <= z[l]).wrapping_neg() & !chosen[0][l];
            chosen[2][l] = !(chosen[0][l] | chosen[1][l]);
        }
        let [left_x, left_y, left_z] = state.left;
        let [plane_x, plane_y, plane_z] = state.plane;
        for l in 0..LANES {
            let crossing = choose!(chosen, l; x[l].to_bits(), y[l].to_bits(), z[l].to_bits());
            let there = u64::from(distance[l] <= f64::from_bits(crossing)).wrapping_neg();
            let left = choose!(chosen, l; left_x[l] as u64, left_y[l] as u64, left_z[l] as u64);
            let leaves = u64::from(left == 0).wrapping_neg() & !there & walking[l];
            let axis = (chosen[1][l] & 1) | (chosen[2][l] & 2);
            steps[l] += walking[l] & 1;
            out[l] = (leaves & axis) | (!leaves & out[l]);
            walking[l] &= !there & !leaves;
        }
        for l in 0..LANES {
            chosen[0][l] &= walking[l];
            chosen[1][l] &= walking[l];
            chosen[2][l] &= walking[l];
            after[l] = choose!(chosen, l; plane_x[l] as u64, plane_y[l] as u64, plane_z[l] as u64);
        }
        let mut ahead = [0.0f64; LANES];
        for l in 0..LANES {
            ahead[l] = planes[after[l] as usize];
        }
        advance!(state, 0, chosen, ahead, at);
        advance!(state, 1, chosen, ahead, at);
        advance!(state, 2, chosen, ahead, at);
    }
    (state.walking, state.out, state.steps, state.tests) = (walking, out, steps, tests);
}
