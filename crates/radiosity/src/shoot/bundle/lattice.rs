//! The planes of the grid as seen from a source, with the block that its rays go through.

use fearless_simd::prelude::*;
use glam::DVec3;

use super::rays::{CHUNKS, LANES, Rays};
use super::way::Way;
use crate::mesh::{Block, Grid};

/// The grid from one source.
pub(crate) struct Lattice<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) block: Block,
    /// The cell of the source.
    pub(crate) start: [u32; 3],
    /// Distance from the source to each plane along its axis, axis after axis; and at the end one that
    /// is never crossed.
    pub(crate) planes: Vec<f64>,
    /// Where the planes of each axis start, and that last one.
    pub(crate) first: [u32; 4],
}

impl<'a> Lattice<'a> {
    pub(crate) fn new(grid: &'a Grid, block: Block, origin: DVec3) -> Lattice<'a> {
        let mut planes = Vec::new();
        let mut first = [0; 4];
        for axis in 0..3 {
            planes.extend(grid.planes[axis].iter().map(|plane| plane - origin[axis]));
            first[axis + 1] = planes.len() as u32;
        }
        planes.push(f64::INFINITY);
        Lattice { grid, block, start: grid.cell_of(origin), planes, first }
    }

    /// The place of the plane that rays in a cell cross next on each axis.
    pub(crate) fn ahead(&self, ways: [Way; 3], cell: [u32; 3]) -> [u32; 3] {
        std::array::from_fn(|axis| match ways[axis] {
            Way::Down => self.first[axis] + cell[axis],
            Way::Level => self.first[3],
            Way::Up => self.first[axis] + cell[axis] + 1,
        })
    }

    /// The rays that cross one plane before another, each given by its axis and its number there:
    /// crossings are sorted by distance, then by axis.
    #[inline(always)]
    pub(crate) fn crossed<S: Simd>(
        &self,
        simd: S,
        rays: &Rays,
        one: (usize, u32),
        other: (usize, u32),
    ) -> u64 {
        let to_one = self.planes[(self.first[one.0] + one.1) as usize];
        let to_other = self.planes[(self.first[other.0] + other.1) as usize];
        let mut crossed = 0;
        for chunk in 0..CHUNKS {
            let one_at = to_one * rays.inverse[one.0][chunk].load(simd);
            let other_at = to_other * rays.inverse[other.0][chunk].load(simd);
            let before =
                if one.0 < other.0 { one_at.simd_le(other_at) } else { one_at.simd_lt(other_at) };
            crossed |= before.to_bitmask() << (chunk * LANES);
        }
        crossed
    }
}
