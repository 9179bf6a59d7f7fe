//! The planes of the grid relative to an emitter, and the block that its rays go through.

use fearless_simd::prelude::*;
use glam::DVec3;

use super::heading::Heading;
use super::rays::{CHUNKS, LANES, Rays};
use crate::mesh::{Block, Grid};

/// The grid as seen from one emitter.
pub(crate) struct GridView<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) block: Block,
    /// The cell of the emitter.
    pub(crate) start: [u32; 3],
    /// Coordinates of all planes relative to the emitter, by axis; then one never crossed.
    pub(crate) planes: Vec<f64>,
    /// Index of the first plane of each axis, and of the last entry.
    pub(crate) first: [u32; 4],
}

impl<'a> GridView<'a> {
    pub(crate) fn new(grid: &'a Grid, block: Block, origin: DVec3) -> GridView<'a> {
        let mut planes = Vec::new();
        let mut first = [0; 4];
        for axis in 0..3 {
            planes.extend(grid.planes[axis].iter().map(|plane| plane - origin[axis]));
            first[axis + 1] = planes.len() as u32;
        }
        planes.push(f64::INFINITY);
        GridView { grid, block, start: grid.cell_of(origin), planes, first }
    }

    /// Index of the plane that rays in a cell cross next on each axis.
    pub(crate) fn ahead(&self, headings: [Heading; 3], cell: [u32; 3]) -> [u32; 3] {
        std::array::from_fn(|axis| match headings[axis] {
            Heading::Down => self.first[axis] + cell[axis],
            Heading::Level => self.first[3],
            Heading::Up => self.first[axis] + cell[axis] + 1,
        })
    }

    /// The rays that cross one plane before another, each given by its axis and its number.
    /// Crossings are sorted by distance, then by axis.
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
