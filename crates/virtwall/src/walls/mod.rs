//! Virtual walls between local environments, the method of RR-3008's reference [1] that masks replaced: energy
//! that leaves an environment is gathered by wall patch and direction, and sent on from there.

mod wall_patch;
mod walls;

pub use wall_patch::WallPatch;
pub(crate) use walls::Walls;
