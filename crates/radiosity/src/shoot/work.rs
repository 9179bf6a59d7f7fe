//! Counts of what a kernel did, for a machine to price.

use std::ops::{Add, AddAssign};

macro_rules! operations {
    ($($(#[$doc:meta])* $variant:ident $name:literal,)*) => {
        /// An operation that kernels count. A machine gives each a price in cycles.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Operation { $($(#[$doc])* $variant,)* }

        impl Operation {
            /// Every operation, in the order in which [`Work`] keeps them.
            pub const ALL: &[Operation] = &[$(Operation::$variant,)*];

            /// The name by which machine files price it.
            pub fn name(self) -> &'static str {
                match self { $(Operation::$variant => $name,)* }
            }
        }
    };
}

operations! {
    /// A pixel of a mask looked at.
    PixelTest "pixel_test",
    /// A ray set up: its direction turned into the source's frame, its entry into the grid found.
    Ray "ray",
    /// A step from a cell of the grid to the next.
    CellStep "cell_step",
    /// A ray tested against a polygon.
    PolygonTest "polygon_test",
    /// A hit turned into its patch, and its share added to the patch's form factor.
    Hit "hit",
    /// A pixel still true tested against the plane of a neighbouring environment (§4.2.3).
    PlaneTest "plane_test",
    /// A patch's radiosity and unshot radiosity updated from its form factor.
    PatchUpdate "patch_update",
    /// A local patch looked at when the next source is chosen.
    PatchScan "patch_scan",
    /// A queued source looked at when the next source is chosen.
    QueueScan "queue_scan",
    /// An 8-byte word of a mask or message copied.
    WordCopied "word_copied",
}

/// How often each operation was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work([u64; Operation::ALL.len()]);

impl Work {
    /// No work.
    pub const NONE: Work = Work([0; Operation::ALL.len()]);

    /// Count `times` more of an operation.
    pub fn count(&mut self, operation: Operation, times: u64) {
        self.0[operation as usize] += times;
    }

    /// How often an operation was done.
    pub fn of(&self, operation: Operation) -> u64 {
        self.0[operation as usize]
    }

    /// All counts, in the order of [`Operation::ALL`].
    pub fn counts(&self) -> impl Iterator<Item = (Operation, u64)> + '_ {
        Operation::ALL.iter().map(|&operation| (operation, self.of(operation)))
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine += theirs;
        }
    }
}

impl Add for Work {
    type Output = Work;
    fn add(mut self, other: Work) -> Work {
        self += other;
        self
    }
}
