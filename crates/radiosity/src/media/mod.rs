//! Participating media that absorb light (§3.2). Shooting through them is in `shoot/dimmed.rs`.

mod depth_bits; // optical depth as an integer for each pixel of a mask
mod medium; // a box of absorbing medium, and the optical depth along a ray

pub use depth_bits::DepthBits;
pub use medium::{Medium, optical_depth};
