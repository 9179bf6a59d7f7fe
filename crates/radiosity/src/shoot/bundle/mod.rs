//! Bundles of 64 neighbouring rays, one for each word of a mask: the parts of the fast path.
//!
//! - `rays`: the rays of a bundle, stored as columns of numbers
//! - `way`: up, down or level: how rays run along an axis
//! - `lattice`: the planes of the grid as seen from an emitter
//! - `entry`: the cells in which rays enter a block
//! - `nearest`: the nearest polygon that each ray hits
//! - `walk`: the cells that the rays pass
//! - `landing`: the patches that the rays hit

mod entry;
mod landing;
mod lattice;
mod nearest;
mod rays;
mod walk;
mod way;

pub(crate) use landing::land;
pub(crate) use lattice::Lattice;
pub(crate) use nearest::Nearest;
pub(crate) use rays::{Bundles, LANES, Rays, WIDTH};
pub(crate) use walk::Walk;
