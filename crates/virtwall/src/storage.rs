//! Where a processor keeps what its kernels touch, and what its caches make of that (§5.2).

use std::sync::Arc;

use multicomputer::{CacheLevel, Caches};
use radiosity::{Block, Record, Side, trace};

use crate::message::Parcel;
use crate::problem::Problem;

/// Bytes of the records that the kernels touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// A direction of the hemisphere.
    pub direction: u64,
    /// The weight of a pixel; 0 where all have the same.
    pub weight: u64,
    /// Where a cell's list begins; the next one's beginning is its end.
    pub cell: u64,
    /// A polygon in a cell's list.
    pub entry: u64,
    /// A polygon, and how much of it is read when a ray is tested against its plane.
    pub polygon: [u64; 2],
    /// A polygon's edges, and how much of them is read when a ray is tested against them.
    pub edges: [u64; 2],
    /// A patch in its polygon's quad-tree.
    pub slot: u64,
    /// A patch's form factor.
    pub form_factor: u64,
    /// A patch, and how much of it is read when the next source is chosen.
    pub patch: [u64; 2],
    /// What the innermost loops have in constant use: frames, ray, source.
    pub hot: u64,
    /// Between an array and the next: an allocator's own.
    pub gap: u64,
    /// Whether each environment keeps its cells and polygons by itself, as it does on a machine without
    /// shared memory.
    pub by_environment: bool,
}

impl Layout {
    /// A plain C program in double precision.
    ///
    /// Choice C17: the paper's is unpublished. The prices of the Paragon's operations count the same
    /// records: a plane on 2 lines of 32 B, 2.5 edges of 24 B, a patch on 3 lines.
    pub const PLAIN_C: Layout = Layout {
        direction: 24,
        weight: 0,
        cell: 4,
        entry: 4,
        polygon: [64, 48],
        edges: [96, 60],
        slot: 4,
        form_factor: 8,
        patch: [96, 8],
        hot: 512,
        gap: 16,
        by_environment: true,
    };
}

/// A processor's caches, and the addresses of what its kernels touch.
pub struct Storage {
    problem: Arc<Problem>,
    layout: Layout,
    caches: Caches,
    directions: u64,
    weights: u64,
    masks: u64,
    mask_bytes: u64,
    masks_used: u64,
    form_factors: u64,
    /// Of each cell, by its place in the grid: its address and that of its list.
    cells: Vec<[u64; 2]>,
    polygons: Vec<Polygons>,
    /// Slots and patches of each environment.
    patches: Vec<[u64; 2]>,
}

/// The polygons of an environment, or of all.
struct Polygons {
    planes: u64,
    edges: u64,
    /// The number here of each polygon of the scene that is here.
    numbers: Vec<u32>,
}

/// Memory, given to arrays one after the other.
struct Room {
    next: u64,
    gap: u64,
}

impl Room {
    fn take(&mut self, records: usize, bytes: u64) -> u64 {
        let start = self.next;
        self.next = (start + records as u64 * bytes).next_multiple_of(16) + self.gap;
        start
    }
}

impl Storage {
    /// Everything in its place, the caches empty.
    pub fn new(problem: &Arc<Problem>, layout: Layout, levels: &[CacheLevel]) -> Storage {
        let whole = problem.space.grid.whole();
        let environments = &problem.environments;
        let most_patches = environments.iter().map(|e| e.patches.len()).max().unwrap_or(0);
        let mask_bytes = u64::from(problem.hemisphere.pixels()).div_ceil(64) * 8;
        let mut room = Room { next: 0, gap: layout.gap };
        let mut storage = Storage {
            problem: Arc::clone(problem),
            caches: Caches::new(levels, layout.hot),
            directions: room.take(problem.hemisphere.directions.len(), layout.direction),
            weights: room.take(problem.hemisphere.directions.len(), layout.weight),
            masks: room.take(environments.len(), mask_bytes),
            mask_bytes,
            masks_used: 0,
            form_factors: room.take(most_patches, layout.form_factor),
            cells: vec![[0; 2]; whole.cells().count()],
            polygons: Vec::new(),
            patches: Vec::new(),
            layout,
        };
        if storage.layout.by_environment {
            environments.iter().for_each(|e| storage.place(e.block, &mut room));
        } else {
            storage.place(whole, &mut room);
        }
        for environment in environments {
            let count = environment.patches.len();
            let bytes = [storage.layout.slot, storage.layout.patch[0]];
            storage.patches.push(bytes.map(|bytes| room.take(count, bytes)));
        }
        storage
    }

    /// Place the cells of a block, their lists and their polygons.
    fn place(&mut self, block: Block, room: &mut Room) {
        let (grid, layout) = (&self.problem.space.grid, &self.layout);
        let (mut count, mut entries) = (0, 0);
        let mut numbers = vec![ABSENT; self.problem.space.scene.polygons.len()];
        for cell in block.cells() {
            let listed = grid.polygons(cell);
            self.cells[grid.index(cell)] = [count * layout.cell, entries * layout.entry];
            count += 1;
            entries += listed.len() as u64;
            listed.iter().for_each(|&polygon| numbers[polygon as usize] = 0);
        }
        let starts =
            [room.take(count as usize + 1, layout.cell), room.take(entries as usize, layout.entry)];
        for cell in block.cells() {
            let place = &mut self.cells[grid.index(cell)];
            *place = [place[0] + starts[0], place[1] + starts[1]];
        }
        let mut polygons = 0;
        for number in numbers.iter_mut().filter(|number| **number != ABSENT) {
            *number = polygons;
            polygons += 1;
        }
        let [planes, edges] =
            [layout.polygon, layout.edges].map(|[bytes, _]| room.take(polygons as usize, bytes));
        self.polygons.push(Polygons { planes, edges, numbers });
    }

    /// Seconds that a source shot in an environment loses to misses, with the search for the next
    /// one afterwards.
    pub fn shoot(&mut self, parcel: &Parcel) -> f64 {
        let before = self.caches.time();
        let problem = Arc::clone(&self.problem);
        let e = parcel.environment as usize;
        let environment = &problem.environments[e];
        let mask = self.next_mask();
        let Parcel { source, mask: pixels, .. } = parcel;
        trace(&problem.space, environment, &problem.hemisphere, source, pixels, |record| {
            self.touch(e, mask, record);
        });
        for _ in Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)) {
            let copy = self.next_mask();
            self.caches.touch(mask, self.mask_bytes);
            self.caches.touch(copy, self.mask_bytes);
        }
        self.pass_over_patches(e);
        self.caches.time() - before
    }

    /// Masks take each other's places, as many in turn as there are environments to wait for.
    fn next_mask(&mut self) -> u64 {
        let place = self.masks + self.masks_used % self.patches.len() as u64 * self.mask_bytes;
        self.masks_used += 1;
        place
    }

    /// Touch a record of an environment.
    #[inline]
    fn touch(&mut self, environment: usize, mask: u64, record: Record) {
        let Storage { layout, caches, .. } = self;
        let polygons = &self.polygons[if layout.by_environment { environment } else { 0 }];
        let number = |polygon: u32| u64::from(polygons.numbers[polygon as usize]);
        match record {
            Record::Direction(pixel) => {
                let pixel = u64::from(pixel);
                caches.touch(mask + pixel / 64 * 8, 8);
                caches.touch(self.directions + pixel * layout.direction, layout.direction);
                if layout.weight > 0 {
                    caches.touch(self.weights + pixel * layout.weight, layout.weight);
                }
            }
            Record::Cell { place, polygons } => {
                let [cell, list] = self.cells[place as usize];
                caches.touch(cell, 2 * layout.cell);
                if polygons > 0 {
                    caches.touch(list, u64::from(polygons) * layout.entry);
                }
            }
            Record::Plane(polygon) => {
                let [whole, read] = layout.polygon;
                caches.touch(polygons.planes + number(polygon) * whole, read);
            }
            Record::Edges(polygon) => {
                let [whole, read] = layout.edges;
                caches.touch(polygons.edges + number(polygon) * whole, read);
            }
            Record::Hit(patch) => {
                let (patch, slots) = (u64::from(patch), self.patches[environment][0]);
                caches.touch(slots + patch * layout.slot, layout.slot);
                caches.touch(self.form_factors + patch * layout.form_factor, layout.form_factor);
            }
        }
    }

    /// Update all patches of an environment, each with its form factor, then look at all.
    fn pass_over_patches(&mut self, environment: usize) {
        let Layout { patch: [whole, scanned], form_factor, .. } = self.layout;
        let count = self.problem.environments[environment].patches.len() as u64;
        let patches = self.patches[environment][1];
        for patch in 0..count {
            self.caches.touch(self.form_factors + patch * form_factor, form_factor);
            self.caches.touch(patches + patch * whole, whole);
        }
        for patch in 0..count {
            self.caches.touch(patches + patch * whole, scanned);
        }
    }

    /// Misses of each level so far, the nearest first.
    pub fn misses(&self) -> Vec<u64> {
        self.caches.misses().collect()
    }
}

/// The number of a polygon that is not there.
const ABSENT: u32 = u32::MAX;
