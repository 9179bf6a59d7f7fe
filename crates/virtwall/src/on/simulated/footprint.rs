//! What the programs keep in a node's memory. A machine file says how many bytes each thing takes.

use multicomputer::{NodeMemory, Segment};
use radiosity::Side;

use crate::problem::{Problem, Source};
use crate::program::Turn;

/// A thing that compute nodes keep. A machine with memory has a size for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Thing {
    /// Code, stack and static data of the program.
    Program,
    /// A direction of the hemisphere's table.
    Direction,
    /// A cell of the grid.
    Cell,
    /// A polygon's entry in the list of a cell.
    CellEntry,
    /// A polygon, or the piece of one in an environment.
    Polygon,
    /// A patch, with its share of the quad-trees.
    Patch,
    /// Geometry and photometry of a queued source.
    Source,
    /// 32 bits of its mask.
    MaskWord,
}

impl Thing {
    /// Every thing with its name in machine files, in the order in which [`Footprint`] keeps them.
    pub const ALL: [(Thing, &'static str); 8] = [
        (Thing::Program, "program"),
        (Thing::Direction, "direction"),
        (Thing::Cell, "cell"),
        (Thing::CellEntry, "cell_entry"),
        (Thing::Polygon, "polygon"),
        (Thing::Patch, "patch"),
        (Thing::Source, "source"),
        (Thing::MaskWord, "mask_word"),
    ];
}

/// The number of each thing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Footprint([u64; Thing::ALL.len()]);

impl Footprint {
    fn with(mut self, thing: Thing, times: usize) -> Footprint {
        self.0[thing as usize] += times as u64;
        self
    }

    /// What each node has once: the program and its table of directions.
    pub fn of_the_program(problem: &Problem) -> Footprint {
        let directions = problem.hemispheres().map(|h| h.pixels() as usize).sum();
        Footprint::default().with(Thing::Program, 1).with(Thing::Direction, directions)
    }

    /// An environment: its patches, its polygons, its part of the grid.
    pub fn of_environment(problem: &Problem, number: u32) -> Footprint {
        let environment = &problem.environments[number as usize];
        let grid = &problem.space.grid;
        let lists = environment.block.cells().map(|cell| grid.polygons(cell).len());
        let (cells, entries) = lists.fold((0, 0), |(cells, all), list| (cells + 1, all + list));
        Footprint::default()
            .with(Thing::Cell, cells)
            .with(Thing::CellEntry, entries)
            .with(Thing::Polygon, environment.polygons())
            .with(Thing::Patch, environment.patches.len())
            .with(Thing::MaskWord, wall_bins(problem, number) * 3)
    }

    /// A source that waits in a queue.
    pub fn of_source(source: &Source) -> Footprint {
        let mask = &source.mask;
        let words = match source.emitter.is_of_a_wall() {
            // Three colours a bin, in single precision.
            true => 3,
            false => (mask.pixels().div_ceil(32) * mask.bits_a_pixel()) as usize,
        };
        Footprint::default().with(Thing::Source, 1).with(Thing::MaskWord, words)
    }

    /// Its bytes; things that the machine has no size for take none.
    pub fn bytes(&self, memory: &NodeMemory) -> u64 {
        let size = |name: &str| memory.sizes.get(name).copied().unwrap_or(0);
        Thing::ALL.iter().zip(self.0).map(|((_, name), times)| size(name) * times).sum()
    }
}

/// Bins of directions on all virtual walls of an environment.
fn wall_bins(problem: &Problem, environment: u32) -> usize {
    let environment = &problem.environments[environment as usize];
    let sides = Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)).count();
    problem.walls.as_ref().map_or(0, |walls| sides * (walls.patches() * walls.bins()) as usize)
}

/// The program and its tables.
pub(super) const PROGRAM: Segment = Segment(u64::MAX);

/// An environment by its number.
pub(super) fn environment(number: u32) -> Segment {
    Segment(number.into())
}

/// A queued source by its turn.
pub(super) fn queued(turn: Turn) -> Segment {
    Segment((1 << 32) + turn)
}
