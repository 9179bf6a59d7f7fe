//! A scene made ready for the programs: meshed, cut into local environments, with its hemispheres.

mod ambient;
mod cut_scene;
mod decomposition;
mod hemispheres;
mod problem;
mod shooting;
mod source;

pub use cut_scene::{CutScene, ProblemError, ProblemOptions};
pub use decomposition::{Decomposition, Mapping, Rank};
pub use problem::Problem;
pub use shooting::{Shooting, SourceSplit};
pub use source::Source;
