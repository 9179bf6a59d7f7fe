//! What light does: scene, polygons, patches, grid, hemisphere, visibility mask, shooting.
//!
//! Knows nothing of processors, messages or time.

mod bounds;
mod scene;

pub use bounds::Bounds;
pub use scene::{Face, Material, Plane, Polygon, Rgb, Scene};
