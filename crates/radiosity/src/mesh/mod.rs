//! The division of space into cells (§3.4) and of surfaces into patches (§4.2.1).
//!
//! - `grid`: the regular grid over the scene, and the cells that a ray passes
//! - `facets`: polygons in the form that ray tests read
//! - `space`: a scene sorted into the grid
//! - `patch`: a patch, and the size of patches
//! - `piece`: the part of a polygon in an environment, with its quad-tree of patches
//! - `environment`: a local environment: a block of cells and the patches of its polygons
//! - `meshing`: cuts polygons out of the scene and divides them into patches
//! - `outline`: the corners of a patch
//! - `parts`: a patch divided into several emitters

mod environment;
mod facets;
mod grid;
mod meshing;
mod outline;
mod parts;
mod patch;
mod piece;
mod space;

pub use environment::LocalEnvironment;
pub(crate) use facets::Facet;
pub use facets::Facets;
pub use grid::{Block, Grid, Passage, Side};
pub use parts::Part;
pub use patch::{Patch, PatchSize};
pub(crate) use piece::Piece;
pub use space::Space;
