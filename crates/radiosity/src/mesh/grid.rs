//! The regular grid of cells over the scene (§4.2.1), and the cells that a ray passes.

use glam::DVec3;

use crate::geometry::{Bounds, Ray, clip_to_box};
use crate::scene::{Polygon, Scene};

/// One of the six sides of a block of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// Whether it is the side with the larger coordinate.
    pub upper: bool,
}

impl Side {
    /// The six sides, in the order of [`Side::index`].
    pub const ALL: [Side; 6] = {
        let mut all = [Side { axis: 0, upper: false }; 6];
        let mut i = 0;
        while i < 6 {
            all[i] = Side { axis: i / 2, upper: i % 2 == 1 };
            i += 1;
        }
        all
    };

    /// Its index in [`Side::ALL`].
    pub fn index(self) -> usize {
        self.axis * 2 + usize::from(self.upper)
    }
}

/// Rounding of distances, as a fraction of the diagonal of the scene: more than that of rays that are not
/// nearly parallel to a plane, and too little to change any other result.
const ROUNDING: f64 = 1e-12;

/// A block of cells: on each axis the first cell and the one after the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// First cell on each axis.
    pub low: [u32; 3],
    /// The cell after the last one on each axis.
    pub high: [u32; 3],
}

impl Block {
    /// Whether a cell is inside.
    pub fn contains(&self, cell: [u32; 3]) -> bool {
        (0..3).all(|a| (self.low[a]..self.high[a]).contains(&cell[a]))
    }

    /// The side through which a ray leaves that never enters the block: the one towards the cell of
    /// its origin. Only an emitter in a side of its own environment has such rays. If there is no
    /// environment behind that side, the ray leaves the scene.
    pub(crate) fn side_towards(&self, start: [u32; 3], up_x: bool) -> Side {
        let beyond = |axis: usize| {
            let upper = start[axis] >= self.high[axis];
            (upper || start[axis] < self.low[axis]).then_some(Side { axis, upper })
        };
        (0..3).find_map(beyond).unwrap_or(Side { axis: 0, upper: up_x })
    }

    /// Its cells. x varies fastest.
    pub fn cells(self) -> impl Iterator<Item = [u32; 3]> {
        let range = move |axis: usize| self.low[axis]..self.high[axis];
        range(2).flat_map(move |z| range(1).flat_map(move |y| range(0).map(move |x| [x, y, z])))
    }
}

/// A regular grid of cells over the whole scene, with the polygons that meet each cell.
///
/// It does not depend on the decomposition: a local environment is a [`Block`] of its cells. A ray
/// passes cells in the order of its plane crossings, sorted by (distance, axis). Each crossing is
/// computed from the plane itself, never by adding increments. So the sequence of cells depends on
/// the ray alone, environments only divide it into sections, and a ray along an edge or through a
/// corner has exactly one owner.
pub struct Grid {
    pub(crate) planes: [Vec<f64>; 3],
    /// Cells per metre.
    per_metre: [f64; 3],
    /// Rounding of a distance, metres: a hit not farther beyond a plane counts as before it.
    pub(crate) rounding: f64,
    /// Index in `polygons` where the list of each cell starts, and the end of the last list.
    starts: Vec<u32>,
    polygons: Vec<u32>,
}

impl Grid {
    /// The planes of a grid of `cells` around a scene. A flat scene gets some thickness.
    pub fn planes(scene: &Scene, cells: [u32; 3]) -> [Vec<f64>; 3] {
        let size = scene.bounds.size();
        let margin = size.map(|s| if s > 0.0 { 0.0 } else { 1e-3 * size.length() });
        let low = scene.bounds.min - margin;
        let size = size + 2.0 * margin;
        std::array::from_fn(|axis| {
            let n = cells[axis];
            (0..=n).map(|i| low[axis] + size[axis] * (f64::from(i) / f64::from(n))).collect()
        })
    }

    /// Sorts the polygons of a scene into the cells between `planes`.
    pub fn new(scene: &Scene, planes: [Vec<f64>; 3]) -> Grid {
        let per_metre = planes
            .each_ref()
            .map(|planes| (planes.len() - 1) as f64 / (planes[planes.len() - 1] - planes[0]));
        let rounding = ROUNDING * scene.bounds.size().length();
        let (starts, polygons) = (Vec::new(), Vec::new());
        let mut grid = Grid { planes, per_metre, rounding, starts, polygons };
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (id, polygon) in scene.polygons.iter().enumerate() {
            let cells = grid.cells_met(scene, polygon);
            pairs.extend(cells.into_iter().map(|cell| (cell, id as u32)));
        }
        pairs.sort_unstable();
        let cell_count = grid.cells().iter().map(|&n| n as usize).product::<usize>();
        grid.starts = vec![0; cell_count + 1];
        for &(cell, _) in &pairs {
            grid.starts[cell as usize + 1] += 1;
        }
        for i in 0..cell_count {
            grid.starts[i + 1] += grid.starts[i];
        }
        grid.polygons = pairs.into_iter().map(|(_, polygon)| polygon).collect();
        grid
    }

    /// Number of planes on each axis.
    pub fn plane_counts(&self) -> [usize; 3] {
        self.planes.each_ref().map(Vec::len)
    }

    /// Number of cells on each axis.
    pub fn cells(&self) -> [u32; 3] {
        std::array::from_fn(|axis| self.planes[axis].len() as u32 - 1)
    }

    /// The whole grid as one block: a single environment.
    pub fn whole(&self) -> Block {
        Block { low: [0; 3], high: self.cells() }
    }

    /// The box of space that a block covers.
    pub fn bounds(&self, block: &Block) -> Bounds {
        let corner = |at: [u32; 3]| {
            DVec3::from_array(std::array::from_fn(|axis| self.planes[axis][at[axis] as usize]))
        };
        Bounds { min: corner(block.low), max: corner(block.high) }
    }

    /// The polygons that meet a cell, in increasing order.
    #[inline]
    pub fn polygons(&self, cell: [u32; 3]) -> &[u32] {
        let i = self.index(cell);
        &self.polygons[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// Number of polygons that meet a cell, given by its index.
    #[inline]
    pub(crate) fn polygons_in(&self, cell: u32) -> u64 {
        u64::from(self.starts[cell as usize + 1] - self.starts[cell as usize])
    }

    /// The index of a cell. x varies fastest.
    #[inline]
    pub fn index(&self, [x, y, z]: [u32; 3]) -> usize {
        let [nx, ny, _] = self.cells();
        (z as usize * ny as usize + y as usize) * nx as usize + x as usize
    }

    /// The cell that contains a coordinate. A coordinate on a plane belongs to the cell above it.
    fn cell_at(&self, axis: usize, coordinate: f64) -> u32 {
        let planes = &self.planes[axis];
        let above = planes.partition_point(|&plane| plane <= coordinate);
        above.clamp(1, planes.len() - 1) as u32 - 1
    }

    /// The planes, as axis and number, that [`Grid::cell_of`] tests for a point, in order.
    pub(crate) fn planes_tested(&self, point: DVec3) -> Vec<(usize, u32)> {
        let mut tested = Vec::new();
        for axis in 0..3 {
            let numbers: Vec<u32> = (0..self.planes[axis].len() as u32).collect();
            _ = numbers.partition_point(|&plane| {
                tested.push((axis, plane));
                self.planes[axis][plane as usize] <= point[axis]
            });
        }
        tested
    }

    /// The cells that a polygon meets. They are widened by the tolerance of the scene, so that a
    /// polygon is also found for a hit that rounding moves to the wrong side of a plane.
    fn cells_met(&self, scene: &Scene, polygon: &Polygon) -> Vec<u32> {
        let corners: Vec<DVec3> = scene.corners(polygon).collect();
        let widen = scene.tolerance();
        let around = Bounds::of(corners.iter().copied());
        let block = Block {
            low: std::array::from_fn(|a| self.cell_at(a, around.min[a] - widen)),
            high: std::array::from_fn(|a| self.cell_at(a, around.max[a] + widen) + 1),
        };
        let meets = |cell: &[u32; 3]| {
            let one = Block { low: *cell, high: cell.map(|c| c + 1) };
            let cell = self.bounds(&one).widened(widen);
            plane_meets(polygon, &cell) && !clip_to_box(&corners, &cell).is_empty()
        };
        block.cells().filter(meets).map(|cell| self.index(cell) as u32).collect()
    }

    /// The cell that contains a point.
    pub fn cell_of(&self, point: DVec3) -> [u32; 3] {
        std::array::from_fn(|axis| self.cell_at(axis, point[axis]))
    }

    /// Starts the passage of a ray through a block, or returns `None` if the ray never enters it.
    /// `start` is the cell of its origin.
    #[inline]
    pub fn enter(&self, block: &Block, ray: &Ray, start: [u32; 3]) -> Option<Passage<'_>> {
        let mut cell = start;
        // A ray enters with its last crossing into the block on any axis.
        let mut entry = (f64::NEG_INFINITY, 0);
        for axis in 0..3 {
            let plane = if start[axis] < block.low[axis] {
                cell[axis] = block.low[axis];
                (ray.direction[axis] > 0.0).then_some(block.low[axis])?
            } else if start[axis] >= block.high[axis] {
                cell[axis] = block.high[axis] - 1;
                (ray.direction[axis] < 0.0).then_some(block.high[axis])?
            } else {
                continue;
            };
            let crossing = (self.crossing(axis, plane, ray), axis);
            if crossing > entry {
                entry = crossing;
            }
        }
        if entry.0 > f64::NEG_INFINITY {
            for axis in (0..3).filter(|&axis| axis != entry.1) {
                cell[axis] = self.cell_before(axis, start[axis], entry, ray);
            }
            if !block.contains(cell) {
                return None;
            }
        }
        let next = std::array::from_fn(|axis| self.next_crossing(axis, cell[axis], ray));
        Some(Passage { grid: self, block: *block, ray: *ray, cell, next })
    }

    /// The cell on an axis after all crossings on that axis that come before `entry`.
    #[inline]
    fn cell_before(&self, axis: usize, start: u32, entry: (f64, usize), ray: &Ray) -> u32 {
        let direction = ray.direction[axis];
        if direction == 0.0 {
            return start;
        }
        // An estimate from the position, then corrected by the crossings themselves.
        let last = self.planes[axis].len() as u32 - 2;
        let along = ray.origin[axis] + direction * entry.0 - self.planes[axis][0];
        let mut cell = ((along * self.per_metre[axis]) as u32).min(last);
        let before = |plane: u32| (self.crossing(axis, plane, ray), axis) < entry;
        if direction > 0.0 {
            cell = cell.max(start);
            while cell < last && before(cell + 1) {
                cell += 1;
            }
            while cell > start && !before(cell) {
                cell -= 1;
            }
        } else {
            cell = cell.min(start);
            while cell > 0 && before(cell) {
                cell -= 1;
            }
            while cell < start && !before(cell + 1) {
                cell += 1;
            }
        }
        cell
    }

    /// Distance at which a ray crosses a plane of the grid.
    #[inline]
    fn crossing(&self, axis: usize, plane: u32, ray: &Ray) -> f64 {
        (self.planes[axis][plane as usize] - ray.origin[axis]) * ray.inverse[axis]
    }

    /// Distance at which a ray leaves a cell along an axis.
    #[inline]
    fn next_crossing(&self, axis: usize, cell: u32, ray: &Ray) -> f64 {
        if ray.direction[axis] == 0.0 {
            f64::INFINITY
        } else {
            self.crossing(axis, cell + u32::from(ray.direction[axis] > 0.0), ray)
        }
    }

    /// Distance at which a ray leaves a block through a side, if at most `distance`, to within rounding.
    pub(crate) fn crosses(
        &self,
        block: &Block,
        Side { axis, upper }: Side,
        ray: &Ray,
        distance: f64,
    ) -> Option<f64> {
        let plane = if upper { block.high[axis] } else { block.low[axis] };
        let ahead = if upper { ray.direction[axis] > 0.0 } else { ray.direction[axis] < 0.0 };
        ahead
            .then(|| self.crossing(axis, plane, ray))
            .filter(|&crossing| crossing <= distance + self.rounding)
    }

    /// The side through which a ray leaves that never enters a block.
    pub fn side_towards(&self, block: &Block, ray: &Ray) -> Side {
        let start = self.cell_of(ray.origin);
        block.side_towards(start, ray.direction.x > 0.0)
    }
}

/// Whether a polygon's plane passes through a box.
fn plane_meets(polygon: &Polygon, cell: &Bounds) -> bool {
    let normal = polygon.plane.normal;
    let reach = normal.abs().dot(cell.size()) * 0.5;
    let middle = (cell.min + cell.max) * 0.5;
    (normal.dot(middle) - polygon.plane.offset).abs() <= reach * (1.0 + 1e-9)
}

/// The passage of a ray through a block, cell by cell.
pub struct Passage<'a> {
    grid: &'a Grid,
    block: Block,
    ray: Ray,
    pub(crate) cell: [u32; 3],
    /// Distance of the next crossing on each axis.
    pub(crate) next: [f64; 3],
}

impl<'a> Passage<'a> {
    /// Polygons of the current cell.
    #[inline]
    pub fn polygons(&self) -> &'a [u32] {
        self.grid.polygons(self.cell)
    }

    /// Distance at which the ray leaves the current cell.
    #[inline]
    fn exit(&self) -> f64 {
        self.next[self.next_axis()]
    }

    /// Distance up to which a hit belongs to the current cell. A ray that hits a polygon where it leaves
    /// the cell ends here, whatever the rounding of both distances.
    #[inline]
    pub fn reach(&self) -> f64 {
        self.exit() + self.grid.rounding
    }

    /// Moves to the next cell, or returns the side through which the ray leaves the block.
    #[inline]
    pub fn step(&mut self) -> Result<(), Side> {
        let axis = self.next_axis();
        let upper = self.ray.direction[axis] > 0.0;
        let at_end = if upper {
            self.cell[axis] + 1 == self.block.high[axis]
        } else {
            self.cell[axis] == self.block.low[axis]
        };
        if at_end {
            return Err(Side { axis, upper });
        }
        self.cell[axis] = if upper { self.cell[axis] + 1 } else { self.cell[axis] - 1 };
        self.next[axis] = self.grid.next_crossing(axis, self.cell[axis], &self.ray);
        Ok(())
    }

    /// The axis of the next crossing. Of equal distances, the lower axis.
    #[inline]
    pub(crate) fn next_axis(&self) -> usize {
        let [x, y, z] = self.next;
        if x <= y && x <= z {
            0
        } else if y <= z {
            1
        } else {
            2
        }
    }
}
