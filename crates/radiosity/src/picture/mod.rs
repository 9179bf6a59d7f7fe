//! Pictures of solved scenes (Figures 7 and 8).

mod camera; // a pinhole camera
mod gltf; // binary glTF files of these triangles
mod render; // pictures, and PNG files of them
mod stitch; // no gaps between patches of different sizes
mod tone; // from radiosity to brightness on a screen
mod triangles; // patches as triangles with radiosity at their corners
mod z_buffer; // which polygon is visible at each sample of a picture

pub use camera::Camera;
pub use render::{LARGEST_PICTURE, Picture, PictureError, PictureOptions, render, studio_light};
pub use tone::{Exposure, Tone};
pub use triangles::{Mesh, Shading};
