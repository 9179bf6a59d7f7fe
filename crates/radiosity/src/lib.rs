//! What light does: scenes, meshes, hemispheres, visibility masks, shooting, pictures.
//!
//! The crate knows nothing of processors, messages or time. Each folder imports only those listed
//! above it:
//!
//! - `geometry`: boxes, rays, clipping: geometry that knows no scene
//! - `media`: participating media that absorb light (§3.2)
//! - `scene`: scenes, read from OBJ and MTL files and cleaned
//! - `mesh`: the grid of cells, local environments and their patches (§4.2.1)
//! - `shoot`: the rays of an emitter through a local environment (§3.3, §4.2.3)
//! - `virtual_walls`: energy gathered by wall patch and direction: the method before masks
//! - `light`: the light on patches; progressive radiosity in one environment (§5.2)
//! - `picture`: images and glTF meshes of solved scenes (Figures 7 and 8)

mod geometry;
mod light;
mod media;
mod mesh;
mod picture;
mod scene;
mod shoot;
mod virtual_walls;

pub use geometry::{Bounds, Ray};
pub use glam;
pub use light::{Greatest, Light, Refinement, RefinementError, Wanted, solve};
pub use media::{DepthBits, Medium, optical_depth};
pub use mesh::{
    Block, Facets, Grid, LocalEnvironment, MOST_PATCHES, Part, Passage, Patch, PatchSize, Side,
    Space, TooManyPatches,
};
pub use picture::{
    Camera, Exposure, LARGEST_PICTURE, Mesh, Picture, PictureError, PictureOptions, Shading, Tone,
    render, studio_light,
};
pub use scene::{
    DEFAULT_REFLECTANCE, Face, Material, MtlMaterial, ObjFile, Plane, Polygon, Rgb, Scene,
    SceneError, Warning, WarningKind, Warnings, load_mtl, load_obj, load_obj_from,
    read_regular_file, turn_faces,
};
pub use shoot::{
    Emitter, End, Hemisphere, HemisphereError, HemisphereKind, MOST_PIXELS, Mask, Operation,
    Outgoing, Record, Shot, Work, cast, shoot, shoot_plainly, trace,
};
pub use virtual_walls::{VirtualWalls, VirtualWallsError};
