//! Pictures of solved scenes (Figures 7 and 8).
//!
//! - `camera`: a pinhole camera
//! - `z_buffer`: which polygon is visible at each sample of a picture
//! - `tone`: from radiosity to brightness on a screen
//! - `render`: pictures, and PNG files of them
//! - `stitch`: no gaps between patches of different sizes
//! - `triangles`: patches as triangles with radiosity at their corners
//! - `gltf`: binary glTF files of these triangles

mod camera;
mod gltf;
mod render;
mod stitch;
mod tone;
mod triangles;
mod z_buffer;

pub use camera::Camera;
pub use render::{LARGEST_PICTURE, Picture, PictureError, PictureOptions, render, studio_light};
pub use tone::{Exposure, Tone};
pub use triangles::{Mesh, Shading};
