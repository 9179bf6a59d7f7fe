//! Where a processor keeps what its kernels touch, and what its caches make of that (§5.2).

use std::sync::Arc;

use multicomputer::{CacheLevel, Caches};
use radiosity::{Block, Hemisphere, Mask, Record, Side, trace};

use crate::message::Parcel;
use crate::problem::Problem;

/// Bytes of the records that the kernels touch: from one to the next, and, where that is less, how
/// many of them are touched.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// A direction of the hemisphere.
    pub direction: u64,
    /// A cell, and what says where its list begins and ends.
    pub cell: [u64; 2],
    /// A polygon in a cell's list.
    pub entry: u64,
    /// A polygon's plane.
    pub plane: [u64; 2],
    /// A polygon's edges.
    pub edges: [u64; 2],
    /// The axes of a polygon's quad-tree.
    pub axes: [u64; 2],
    /// A slot of the quad-tree.
    pub slot: u64,
    /// A patch, what an update touches of it, and its energy and form factor.
    pub patch: [u64; 3],
    /// What each ray, each cell and each polygon touches of frames and variables.
    pub frames: [u64; 3],
    /// Between an array and the next: an allocator's own.
    pub gap: u64,
    /// Whether each environment keeps its cells and polygons by itself, as it does on a machine without
    /// shared memory.
    pub by_environment: bool,
}

impl Layout {
    /// A plain C program in double precision.
    ///
    /// Choice C17: the paper's is unpublished. These are the records whose sizes
    /// `machines/paragon-gp16.json` gives and whose misses the prices of the Paragon's operations hold: of
    /// a polygon's 264 B its plane, 2.5 of its corners and its axes, of a patch's 300 B, aligned, its
    /// form factor, energies, reflectance and area.
    pub const PLAIN_C: Layout = Layout {
        direction: 24,
        cell: [8, 8],
        entry: 8,
        plane: [48, 48],
        edges: [96, 60],
        axes: [64, 64],
        slot: 4,
        patch: [304, 96, 8],
        frames: [512, 144, 72],
        gap: 16,
        by_environment: true,
    };
}

/// A processor's caches, and the addresses of what its kernels touch.
pub struct Storage {
    problem: Arc<Problem>,
    layout: Layout,
    caches: Caches,
    frames: u64,
    directions: u64,
    masks: u64,
    mask_bytes: u64,
    masks_used: u64,
    /// Of each cell, by its place in the grid: its address and that of its list.
    cells: Vec<[u64; 2]>,
    polygons: Vec<Polygons>,
    /// Slots and patches of each environment.
    patches: Vec<[u64; 2]>,
}

/// Where the polygons of an environment, or of all, are.
struct Polygons {
    planes: u64,
    edges: u64,
    axes: u64,
    /// The number here of each polygon of the scene; of one that is not here it says nothing.
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
        let mask_bytes = u64::from(problem.hemisphere.pixels()).div_ceil(64) * 8;
        let directions = problem.hemispheres().map(|h| h.directions.len()).sum();
        let mut room = Room { next: 0, gap: layout.gap };
        let mut storage = Storage {
            problem: Arc::clone(problem),
            caches: Caches::new(levels),
            frames: room.take(1, layout.frames[0]),
            directions: room.take(directions, layout.direction),
            masks: room.take(environments.len(), mask_bytes),
            mask_bytes,
            masks_used: 0,
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
        let Storage { layout, problem, .. } = self;
        let grid = &problem.space.grid;
        let lists = || block.cells().map(|cell| (grid.index(cell), grid.polygons(cell)));
        let mut next = [
            room.take(lists().count(), layout.cell[0]),
            room.take(lists().map(|(_, list)| list.len()).sum(), layout.entry),
        ];
        let mut here = vec![false; problem.space.scene.polygons.len()];
        for (cell, list) in lists() {
            self.cells[cell] = next;
            next[0] += layout.cell[0];
            next[1] += layout.entry * list.len() as u64;
            list.iter().for_each(|&polygon| here[polygon as usize] = true);
        }
        let mut count = 0;
        let number = |is_here: bool| {
            count += u32::from(is_here);
            count.saturating_sub(1)
        };
        let numbers = here.into_iter().map(number).collect();
        let mut take = |[bytes, _]: [u64; 2]| room.take(count as usize, bytes);
        let [planes, edges, axes] = [layout.plane, layout.edges, layout.axes].map(&mut take);
        self.polygons.push(Polygons { planes, edges, axes, numbers });
    }

    /// Touch what a source shot in an environment touches, with the search for the next one afterwards.
    pub fn shoot(&mut self, parcel: &Parcel) {
        let problem = Arc::clone(&self.problem);
        let e = parcel.environment as usize;
        let environment = &problem.environments[e];
        let mask = self.next_mask();
        let Parcel { source, mask: pixels, .. } = parcel;
        let hemisphere = problem.rays_of(source, pixels);
        let directions = self.directions_of(pixels);
        trace(&problem.space, environment, hemisphere, source, pixels, |record| {
            self.touch(e, [mask, directions], record);
        });
        let bytes = pixels.words().len() as u64 * 8;
        for _ in Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)) {
            let copy = self.next_mask();
            self.caches.touch(mask, bytes);
            self.caches.touch(copy, bytes);
        }
        self.pass_over_patches(e);
    }

    /// Masks take each other's places, as many in turn as there are environments to wait for.
    fn next_mask(&mut self) -> u64 {
        let place = self.masks + self.masks_used % self.patches.len() as u64 * self.mask_bytes;
        self.masks_used += 1;
        place
    }

    /// The table of directions that a mask belongs to: they lie one after the other.
    fn directions_of(&self, mask: &Mask) -> u64 {
        let own = self.problem.hemisphere_of(mask).pixels();
        let hemispheres = self.problem.hemispheres().map(Hemisphere::pixels);
        let before = hemispheres.take_while(|&pixels| pixels != own);
        self.directions + before.map(u64::from).sum::<u64>() * self.layout.direction
    }

    /// Touch a record of an environment.
    #[inline]
    fn touch(&mut self, environment: usize, [mask, directions]: [u64; 2], record: Record) {
        let Storage { layout, caches, .. } = self;
        let polygons = &self.polygons[if layout.by_environment { environment } else { 0 }];
        let mut touch = |array: u64, number: u32, [bytes, touched]: [u64; 2]| {
            caches.touch(array + u64::from(number) * bytes, touched);
        };
        let place = |polygon: u32| polygons.numbers[polygon as usize];
        let [ray, cell, polygon] = layout.frames;
        match record {
            Record::Direction(pixel) => {
                touch(self.frames, 0, [0, ray]);
                touch(mask, pixel / 64, [8, 8]);
                touch(directions, pixel, [layout.direction; 2]);
            }
            Record::Cell { place, polygons } => {
                let [here, list] = self.cells[place as usize];
                touch(self.frames, 0, [0, cell]);
                touch(here, 0, layout.cell);
                if polygons > 0 {
                    touch(list, 0, [0, u64::from(polygons) * layout.entry]);
                }
            }
            Record::Plane(number) => {
                touch(self.frames, 0, [0, polygon]);
                touch(polygons.planes, place(number), layout.plane);
            }
            Record::Edges(polygon) => touch(polygons.edges, place(polygon), layout.edges),
            Record::Hit { polygon, patch } => {
                let ([slots, patches], [bytes, _, energy]) =
                    (self.patches[environment], layout.patch);
                touch(polygons.axes, place(polygon), layout.axes);
                touch(slots, patch, [layout.slot; 2]);
                touch(patches, patch, [bytes, energy]);
            }
        }
    }

    /// Update all patches of an environment, then look at all.
    fn pass_over_patches(&mut self, environment: usize) {
        let [bytes, updated, energy] = self.layout.patch;
        let count = self.problem.environments[environment].patches.len() as u64;
        for touched in [updated, energy] {
            let starts = (0..count).map(|patch| self.patches[environment][1] + patch * bytes);
            starts.for_each(|start| self.caches.touch(start, touched));
        }
    }

    /// Misses of each level so far, the nearest first.
    pub fn misses(&self) -> Vec<u64> {
        self.caches.misses().collect()
    }

    /// Seconds that all misses so far cost.
    pub fn time(&self) -> f64 {
        self.caches.time()
    }
}
