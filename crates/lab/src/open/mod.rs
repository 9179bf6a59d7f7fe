//! Scenes and machines: from their files to meshed and cut problems.

pub mod cut; // The automatic grid and decomposition.
pub mod first_light; // Where the light of the lamps falls first.
pub mod flip; // Faces turned over to the light.
pub mod lighting; // Warnings about a scene's light.
pub mod machine_file; // A machine file, with the files that it extends.
pub mod medium; // A participating medium in a scene description.
pub mod open_scene; // A scene outside any experiment.
pub mod problem; // A scene, meshed and cut.
pub mod ray_bench; // Rays from random points, to measure the kernel with.
pub mod scene; // A scene: description and geometry.
pub mod scene_file; // A scene description.
pub mod settings; // How a scene is meshed and cut, and its hemisphere.
pub mod surface; // Changes of materials in a scene description.
pub mod unit; // The unit of an OBJ file.
pub mod up; // The upward direction of a scene.
