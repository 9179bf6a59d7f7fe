//! Geometry that does not depend on scenes.

mod bounds; // axis-aligned boxes
mod box_tree; // a bounding volume hierarchy: which boxes can a bundle of rays meet?
mod clip; // clipping of convex polygons
mod pairs; // the pairs of boxes that meet
mod pyramid; // the four planes around a bundle of rays
mod ray; // a ray
mod split; // how boxes are split into groups for the tree

pub use bounds::Bounds;
pub(crate) use box_tree::{BoxTree, VisitStack};
pub(crate) use clip::{area_and_centroid, clip_to_box, clip_to_half, clip_to_slab, cut_by_edge};
pub(crate) use pairs::visit_pairs;
pub(crate) use pyramid::Pyramid;
pub use ray::Ray;
