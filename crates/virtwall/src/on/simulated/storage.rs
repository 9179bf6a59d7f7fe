//! The addresses of the records that the kernels touch, and the caches in front of them (§5.2).

use std::sync::Arc;

use multicomputer::Caches;
use radiosity::{Block, Hemisphere, Mask, Record, trace};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::layout::Layout;
use crate::problem::{Problem, Source};

/// A page of memory, bytes.
const PAGE: u64 = 4096;

/// A processor's caches, and the addresses of what its kernels touch.
pub struct Storage {
    problem: Arc<Problem>,
    layout: Layout,
    caches: Caches,
    scalars: [u64; 6],
    directions: u64,
    masks: u64,
    mask_bytes: u64,
    masks_used: u64,
    /// The planes of the grid across each axis.
    crossings: [u64; 3],
    /// Address of each cell and of its list, by the cell's place in the grid.
    cells: Vec<[u64; 2]>,
    polygons: Vec<Polygons>,
    /// Numbers of polygons, slots and patches of each environment.
    patches: Vec<[u64; 3]>,
}

/// Where the polygons of an environment, or of all, are.
struct Polygons {
    planes: u64,
    edges: u64,
    axes: u64,
    /// The number here of each polygon of the scene that is here; others have no meaning.
    numbers: Vec<u32>,
}

/// Address space, given to arrays one after the other.
struct AddressSpace {
    next: u64,
    padding: Option<ChaCha8Rng>,
}

impl AddressSpace {
    fn take(&mut self, records: usize, bytes: u64) -> u64 {
        let start = self.next;
        let apart =
            self.padding.as_mut().map_or(0, |padding| padding.random_range(0..PAGE / 16) * 16);
        self.next = (start + records as u64 * bytes).next_multiple_of(16) + 16 + apart;
        start
    }
}

impl Storage {
    /// All records at their addresses, behind these caches.
    pub fn new(problem: &Arc<Problem>, layout: Layout, caches: Caches) -> Storage {
        let whole = problem.space.grid.whole();
        let environments = &problem.environments;
        let mask_bytes = u64::from(problem.hemisphere.pixels()).div_ceil(64) * 8;
        let directions = problem.hemispheres().map(|h| h.directions.len()).sum();
        let mut room =
            AddressSpace { next: 0, padding: layout.padding_seed.map(ChaCha8Rng::seed_from_u64) };
        let scalars = layout.scalars.map(|touched| touched[0]);
        let stack = room.take(1, scalars[0]);
        let mut storage = Storage {
            problem: Arc::clone(problem),
            caches,
            scalars: [stack, 0, 0, 0, 0, 0],
            directions: room.take(directions, layout.direction),
            crossings: problem.space.grid.plane_counts().map(|n| room.take(n, layout.crossing)),
            masks: room.take(environments.len(), mask_bytes),
            mask_bytes,
            masks_used: 0,
            cells: vec![[0; 2]; whole.cells().count()],
            polygons: Vec::new(),
            patches: Vec::new(),
            layout,
        };
        storage.scalars[1] = room.take(1, scalars[1]);
        storage.scalars[3] = room.take(1, scalars[3]);
        if storage.layout.by_environment {
            environments.iter().for_each(|e| storage.place(e.block, &mut room));
        } else {
            storage.place(whole, &mut room);
        }
        storage.scalars[4] = room.take(1, scalars[4]);
        for environment in environments {
            let Layout { number, slot, patch, .. } = &storage.layout;
            let patches = environment.patches.len();
            storage.patches.push([
                room.take(problem.space.scene.polygons.len(), *number),
                room.take(patches, *slot),
                room.take(patches, patch[0]),
            ]);
        }
        storage.scalars[2] = room.take(1, scalars[2]);
        storage.scalars[5] = room.take(1, scalars[5]);
        storage
    }

    /// Place the cells of a block, their lists and their polygons.
    fn place(&mut self, block: Block, room: &mut AddressSpace) {
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
        let bytes = [layout.plane[0], layout.edges[0], layout.axes[0]];
        let [planes, edges, axes] = bytes.map(|bytes| room.take(count as usize, bytes));
        self.polygons.push(Polygons { planes, edges, axes, numbers });
    }

    /// Touch the records of a shot, and of the search for the next source.
    pub fn shoot(&mut self, source: &Source) {
        let problem = Arc::clone(&self.problem);
        let e = source.environment as usize;
        let environment = &problem.environments[e];
        let mask = self.next_mask();
        let Source { emitter, mask: pixels, .. } = source;
        let hemisphere = problem.rays_of(emitter, pixels);
        let (directions, bytes) = (self.directions_of(pixels), pixels.words().len() as u64 * 8);
        let mut copy = mask;
        trace(&problem.space, environment, hemisphere, emitter, pixels, |record| {
            if record == Record::Copy {
                copy = self.next_mask();
                self.caches.touch(mask, bytes);
                self.caches.touch(copy, bytes);
            }
            self.touch(e, [mask, copy, directions], record);
        });
        self.pass_over_patches(e);
    }

    /// Masks are stored in a ring of as many places as there are environments.
    fn next_mask(&mut self) -> u64 {
        let place = self.masks + self.masks_used % self.patches.len() as u64 * self.mask_bytes;
        self.masks_used += 1;
        place
    }

    /// The address of the table of directions that a mask belongs to.
    fn directions_of(&self, mask: &Mask) -> u64 {
        let own = self.problem.hemisphere_of(mask).pixels();
        let hemispheres = self.problem.hemispheres().map(Hemisphere::pixels);
        let before = hemispheres.take_while(|&pixels| pixels != own);
        self.directions + before.map(u64::from).sum::<u64>() * self.layout.direction
    }

    /// Touch a record of an environment; `places` are the addresses of the mask, its copy and the directions.
    #[inline]
    fn touch(&mut self, environment: usize, places: [u64; 3], record: Record) {
        let [mask, copy, directions] = places;
        let Storage { layout, caches, .. } = self;
        let polygons = &self.polygons[if layout.by_environment { environment } else { 0 }];
        let mut touch = |array: u64, number: u32, [bytes, touched]: [u64; 2]| {
            if touched > 0 {
                caches.touch(array + u64::from(number) * bytes, touched);
            }
        };
        let scalars = match record {
            Record::Direction(_) => Some(0),
            Record::Cell { .. } => Some(1),
            Record::Plane(_) => Some(2),
            Record::PlaneTest(_) => Some(3),
            _ => None,
        };
        for (&place, bytes) in self.scalars.iter().zip(layout.scalars) {
            scalars.into_iter().for_each(|of| touch(place, 0, [0, bytes[of]]));
        }
        let place = |polygon: u32| polygons.numbers[polygon as usize];
        match record {
            Record::Direction(pixel) => {
                touch(mask, pixel / 64, [8, 8]);
                touch(directions, pixel, [layout.direction; 2]);
            }
            Record::Search { axis, plane } | Record::Crossing { axis, plane } => {
                touch(self.crossings[axis], plane, [layout.crossing; 2]);
            }
            Record::Cell { place, polygons } => {
                let [here, list] = self.cells[place as usize];
                touch(here, 0, layout.cell);
                touch(list, 0, [0, u64::from(polygons) * layout.entry]);
            }
            Record::Plane(number) => {
                let [bytes, tested, _] = layout.plane;
                touch(polygons.planes, place(number), [bytes, tested]);
            }
            Record::Edges { polygon, edges } => {
                let ([bytes, edge], [plane, _, met]) = (layout.edges, layout.plane);
                touch(polygons.planes, place(polygon), [plane, met]);
                touch(polygons.edges, place(polygon), [bytes, u64::from(edges) * edge]);
            }
            Record::Hit { polygon, patch } => {
                let ([numbers, slots, patches], [bytes, _, energy]) =
                    (self.patches[environment], layout.patch);
                touch(numbers, polygon, [layout.number; 2]);
                touch(polygons.axes, place(polygon), layout.axes);
                touch(slots, patch, [layout.slot; 2]);
                touch(patches, patch, [bytes, energy]);
            }
            Record::Copy => {}
            Record::PlaneTest(pixel) => {
                touch(directions, pixel, [layout.direction; 2]);
                touch(copy, pixel / 64, [8, 8]);
            }
        }
    }

    /// Update all patches of an environment, then look at all.
    fn pass_over_patches(&mut self, environment: usize) {
        let [bytes, updated, energy] = self.layout.patch;
        let count = self.problem.environments[environment].patches.len() as u64;
        for touched in [updated, energy] {
            let starts = (0..count).map(|patch| self.patches[environment][2] + patch * bytes);
            starts.for_each(|start| self.caches.touch(start, touched));
        }
    }

    /// The caches.
    pub fn caches(&self) -> &Caches {
        &self.caches
    }
}
