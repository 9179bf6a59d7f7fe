//! The parts of the fast path, which casts bundles of 64 neighbouring rays, one bundle for each
//! word of a mask.
//!
//! - `rays`: the rays of a bundle, stored as columns of numbers
//! - `heading`: up, down or level: how rays run along an axis
//! - `grid_view`: the planes of the grid as seen from an emitter
//! - `entry`: the cells in which rays enter a block
//! - `nearest`: the nearest polygon that each ray hits
//! - `walk`: the cells that the rays pass
//! - `patches_hit`: the patches that the rays hit

mod entry;
mod grid_view;
mod heading;
mod nearest;
mod patches_hit;
mod rays;
mod walk;

pub(crate) use grid_view::GridView;
pub(crate) use nearest::Nearest;
pub(crate) use patches_hit::find_patches;
pub(crate) use rays::{Bundles, LANES, Rays, WIDTH};
pub(crate) use walk::Walk;
