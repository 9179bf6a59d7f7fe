//! What light does: scene, polygons, patches, grid, hemisphere, visibility mask, shooting.
//!
//! Knows nothing of processors, messages or time.

mod bounds;
mod bundle;
mod camera;
mod canvas;
mod clean;
mod clip;
mod entry;
mod environment;
mod facets;
mod form_factors;
mod greatest;
mod grid;
mod hemisphere;
mod landing;
mod lattice;
mod light;
mod mask;
mod mtl;
mod nearest;
mod obj;
mod outline;
mod parts;
mod picture;
mod plain;
mod pyramid;
mod scene;
mod scene_error;
mod shoot;
mod shot;
mod solve;
mod space;
mod split;
mod text;
mod tree;
mod walk;
mod warning;
mod way;
mod work;

pub use bounds::Bounds;
pub use camera::Camera;
pub use environment::{LocalEnvironment, Patch, PatchSize};
pub use facets::{Facets, Ray};
pub use glam;
pub use greatest::Greatest;
pub use grid::{Block, Grid, Passage, Side};
pub use hemisphere::{Hemisphere, HemisphereError, HemisphereKind, MOST_PIXELS};
pub use light::Light;
pub use mask::Mask;
pub use mtl::DEFAULT_REFLECTANCE;

pub use obj::{load_obj, load_obj_from};
pub use parts::Part;
pub use picture::{Exposure, Picture, PictureError, PictureOptions, render, studio_light};
pub use plain::{End, cast, shoot_plainly};
pub use scene::{Face, Material, Plane, Polygon, Rgb, Scene};
pub use scene_error::SceneError;
pub use shoot::shoot;
pub use shot::{Outgoing, Shot, Source};
pub use solve::solve;
pub use space::Space;
pub use warning::{Warning, WarningKind, Warnings};
pub use work::{Operation, Work};
