//! Scenes: read from OBJ and MTL files, and cleaned for the method.
//!
//! - `scene`: materials, planes, polygons, scenes
//! - `error`: why files or faces do not make a scene
//! - `warnings`: what cleaning dropped, changed or replaced
//! - `coplanar`: one plane, equal to the bit, for polygons that share a plane
//! - `clean`: from faces to polygons: welded, convex, planar, without duplicates
//! - `text`: text files, and lines in them
//! - `mtl`: material files
//! - `obj`: Wavefront OBJ files

mod clean;
mod coplanar;
mod error;
mod mtl;
mod obj;
mod scene;
mod text;
mod warnings;

pub use error::SceneError;
pub use mtl::DEFAULT_REFLECTANCE;
pub use obj::{load_obj, load_obj_from};
pub use scene::{Face, Material, Plane, Polygon, Rgb, Scene};
pub use warnings::{Warning, WarningKind, Warnings};
