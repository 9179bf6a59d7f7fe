//! Scenes and machines: from their files to meshed and cut problems.
//!
//! - [`scene_file`]: A scene description.
//! - [`medium`]: A participating medium in a scene description.
//! - [`scene`]: A scene: description and geometry.
//! - [`machine_file`]: A machine file, with the files that it extends.
//! - [`cut`]: The automatic grid and decomposition.
//! - [`settings`]: How a scene is meshed and cut, and its hemisphere.
//! - [`problem`]: A scene, meshed and cut.
//! - [`open_scene`]: A scene outside any experiment.
//! - [`ray_bench`]: Rays from random points, to measure the kernel with.

pub mod cut;
pub mod machine_file;
pub mod medium;
pub mod open_scene;
pub mod problem;
pub mod ray_bench;
pub mod scene;
pub mod scene_file;
pub mod settings;
