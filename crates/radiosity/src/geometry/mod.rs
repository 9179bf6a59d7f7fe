//! Geometry that knows no scene.
//!
//! - `bounds`: axis-aligned boxes
//! - `ray`: a ray
//! - `clip`: clipping of convex polygons
//! - `pyramid`: the four planes around a bundle of rays
//! - `split`: how boxes are split into groups for the tree
//! - `box_tree`: a bounding volume hierarchy: which boxes can a bundle of rays meet?

mod bounds;
mod box_tree;
mod clip;
mod pyramid;
mod ray;
mod split;

pub use bounds::Bounds;
pub(crate) use box_tree::{BoxTree, VisitStack};
pub(crate) use clip::{area_and_centroid, clip_to_box, clip_to_half, clip_to_slab};
pub(crate) use pyramid::Pyramid;
pub use ray::Ray;
