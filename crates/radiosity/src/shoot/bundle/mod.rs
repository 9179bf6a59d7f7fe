//! The parts of the fast path: bundles of 64 neighbouring rays, one for each word of a mask.

mod entry; // the cells in which rays enter a block
mod grid_view; // the planes of the grid as seen from an emitter
mod heading; // up, down or level: how rays run along an axis
mod nearest; // the nearest polygon that each ray hits
mod patches_hit; // the patches that the rays hit
mod rays; // the rays of a bundle, stored as columns of numbers
mod walk; // the cells that the rays pass

pub(crate) use grid_view::GridView;
pub(crate) use nearest::Nearest;
pub(crate) use patches_hit::find_patches;
pub(crate) use rays::{Bundles, LANES, Rays, WIDTH};
pub(crate) use walk::Walk;
