//! The division of space into cells and of surfaces into patches (§4.2.1).

mod environment; // a local environment: a block of cells and the patches of its polygons
mod facets; // polygons in the form that ray tests read
mod grid; // the regular grid over the scene, and the cells that a ray passes
mod meshing; // cuts polygons out of the scene and divides them into patches
mod nearest_slots; // the nearest full slot of each empty slot
mod outline; // the corners of a patch
mod parts; // a patch divided into several emitters
mod patch; // a patch, and the size of patches
mod patch_count; // how many patches a size makes
mod piece; // the part of a polygon in an environment, with its quad-tree of patches
mod shape; // the shape of a piece, and its division into slots
mod space; // a scene sorted into the grid

pub use environment::LocalEnvironment;
pub(crate) use facets::Facet;
pub use facets::Facets;
pub use grid::{Block, Grid, Passage, Side};
pub use parts::Part;
pub use patch::{Patch, PatchSize};
pub use patch_count::{MOST_PATCHES, TooManyPatches};
pub(crate) use piece::Piece;
pub use space::Space;
