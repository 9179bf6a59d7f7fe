//! Scenes: read from OBJ and MTL files, and cleaned for the method.

mod clean; // from faces to polygons: welded, convex, planar, without duplicates
mod coplanar; // one plane, equal to the bit, for polygons that share a plane
mod error; // why files or faces do not make a scene
mod flat; // corners moved onto the planes of their polygons
mod mtl; // material files
mod obj; // Wavefront OBJ files
mod overlaps; // overlapping polygons of one plane: covered parts are cut away
mod scene; // materials, planes, polygons, scenes
mod text; // text files, and lines in them
mod turn; // faces of an OBJ file turned over, in its text
mod warnings; // what cleaning dropped, changed or replaced

pub use error::SceneError;
pub use mtl::{MtlMaterial, load_mtl};
pub use obj::{ObjFile, load_obj, load_obj_from};
pub use scene::{DEFAULT_REFLECTANCE, Face, Material, Plane, Polygon, Rgb, Scene};
pub use text::read_regular_file;
pub use turn::turn_faces;
pub use warnings::{Warning, WarningKind, Warnings};
