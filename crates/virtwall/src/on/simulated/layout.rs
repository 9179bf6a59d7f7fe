//! The sizes of the records that the kernels of the priced program touch.

/// Bytes of the records that the kernels touch: the distance from one to the next and, where it is less, the
/// number of bytes touched.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// A direction of the hemisphere.
    pub direction: u64,
    /// A cell, and the start and end of its list.
    pub cell: [u64; 2],
    /// A polygon in a cell's list.
    pub entry: u64,
    /// The position of a plane of the grid.
    pub crossing: u64,
    /// A polygon's plane, the bytes that each test touches, and those of a test whose plane is hit.
    pub plane: [u64; 3],
    /// A polygon's edges, and one of them.
    pub edges: [u64; 2],
    /// A polygon's number among those of its environment, if they are all kept together.
    pub number: u64,
    /// The axes of a polygon's quad-tree.
    pub axes: [u64; 2],
    /// A slot of the quad-tree.
    pub slot: u64,
    /// A patch, the bytes that an update touches, and its energy and form factor.
    pub patch: [u64; 3],
    /// Bytes outside records that each ray, each cell, each test of a polygon and each test of a neighbour's
    /// plane touches, place by place.
    pub scalars: [[u64; 4]; 6],
    /// Seed for random padding between arrays, of up to a page. Without it they follow each other with an
    /// allocator's 16 bytes between them.
    pub padding_seed: Option<u64>,
    /// Whether each environment has its own cells and polygons, as on a machine without shared memory.
    pub by_environment: bool,
}

impl Layout {
    /// A plain C program in double precision.
    ///
    /// Choice C17: the paper's is unpublished. These are the records whose sizes are in
    /// `machines/paragon-gp16.json` and whose misses are included in the prices of the Paragon's operations. Of
    /// a polygon's 264 B a ray touches the plane, the edges up to the one that it passes outside, and the
    /// axes; of a patch's 300 B, aligned, form factor, energies, reflectance and area.
    ///
    /// Scalars were measured once on the kernel in `plain.rs`, compiled for x86-64: lines of 32 B that more than
    /// half of all rays, cells and tests touched while 3,000 rays were cast from the lamp of the Cornell box
    /// (`valgrind --tool=lackey --trace-mem=yes`). Those of plane tests are the operands of its instructions.
    pub const PLAIN_C: Layout = Layout {
        direction: 24,
        cell: [8, 8],
        entry: 8,
        crossing: 8,
        plane: [48, 48, 48],
        edges: [96, 24],
        number: 0,
        axes: [64, 64],
        slot: 4,
        patch: [304, 96, 8],
        scalars: [
            [896, 352, 64, 320], // the stack
            [288, 64, 32, 192],  // constants
            [96, 0, 0, 32],      // addresses of functions
            [64, 0, 0, 32],      // where the directions and the patches are
            [96, 0, 0, 0],       // where the pieces of polygons are
            [224, 32, 0, 0],     // where the grid and the polygons are
        ],
        padding_seed: None,
        by_environment: true,
    };
}
