//! Counts of the operations of a kernel, from which a machine model computes time.

use std::ops::{Add, AddAssign};

macro_rules! operations {
    ($(#[doc = $about:literal] $variant:ident $name:literal,)*) => {
        /// An operation that kernels count. Machine models give each a cost in cycles.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Operation { $(#[doc = $about] $variant,)* }

        impl Operation {
            /// All operations, in the order of [`Work`].
            pub const ALL: &[Operation] = &[$(Operation::$variant,)*];

            /// Its name in machine files.
            pub fn name(self) -> &'static str {
                match self { $(Operation::$variant => $name,)* }
            }

            /// What it is, in a sentence.
            pub fn about(self) -> &'static str {
                match self { $(Operation::$variant => $about.trim_ascii(),)* }
            }
        }
    };
}

operations! {
    /// A pixel of a mask tested.
    PixelTest "pixel_test",
    /// A ray set up: direction rotated into the frame of the emitter, entry into the grid found.
    Ray "ray",
    /// A step from a cell of the grid to the next.
    CellStep "cell_step",
    /// A ray tested against a polygon.
    PolygonTest "polygon_test",
    /// The patch of a hit found, and the pixel added to its form factor.
    Hit "hit",
    /// A pixel still true tested against the plane of a neighbouring environment (§4.2.3).
    PlaneTest "plane_test",
    /// Radiosity and unshot radiosity of a patch updated from its form factor.
    PatchUpdate "patch_update",
    /// A local patch compared in the search for the next source.
    PatchScan "patch_scan",
    /// A queued source compared in the search for the next source.
    QueueScan "queue_scan",
    /// An 8-byte word of a mask or message copied.
    WordCopied "word_copied",
}

/// Counts of all operations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work([u64; Operation::ALL.len()]);

impl Work {
    /// No work.
    pub const NONE: Work = Work([0; Operation::ALL.len()]);

    /// Adds `times` to the count of an operation.
    pub fn count(&mut self, operation: Operation, times: u64) {
        self.0[operation as usize] += times;
    }

    /// The count of an operation.
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
