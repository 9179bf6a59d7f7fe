//! The division of space into cells (§3.4) and of surfaces into patches (§4.2.1).
//!
//! - `grid`: the regular grid over the scene, and the cells that a ray passes
//! - `facets`: polygons in the form that ray tests read
//! - `space`: a scene sorted into the grid
//! - `environment`: a local environment: a block of cells and the patches of its polygons
//! - `outline`: the corners of a patch
//! - `parts`: a patch divided into several emitters

mod environment;
mod facets;
mod grid;
mod outline;
mod parts;
mod space;

pub(crate) use environment::Piece;
pub use environment::{LocalEnvironment, Patch, PatchSize};
pub(crate) use facets::Facet;
pub use facets::Facets;
pub use grid::{Block, Grid, Passage, Side};
pub use parts::Part;
pub use space::Space;
