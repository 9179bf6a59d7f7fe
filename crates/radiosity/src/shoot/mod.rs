//! Shooting: the rays of an emitter through one local environment (§3.3, §4.2.3).
//!
//! - `work`: counts of operations, which a machine prices
//! - `mask`: the visibility mask (§3.2)
//! - `directions`: sets of directions: Fibonacci, hemicube, polar, concentric
//! - `hemisphere`: the directions of the rays over an emitter (§3.2)
//! - `form_factors`: sums of the weights of pixels
//! - `shot`: an emitter, and the result of its shot in one environment
//! - `plain`: one ray at a time: the slow path that tests compare the fast path with
//! - `dimmed`: shooting in a scene with participating media
//! - `bundle`: 64 rays at a time: the parts of the fast path
//! - `kernel`: `shoot`, the fast path
//! - `trace`: the records that a shot reads and writes, for models of caches

mod bundle;
mod dimmed;
mod directions;
mod form_factors;
mod hemisphere;
mod kernel;
mod mask;
mod plain;
mod shot;
mod trace;
mod work;

pub(crate) use directions::unlifted;
pub use hemisphere::{Hemisphere, HemisphereError, HemisphereKind, MOST_PIXELS};
pub use kernel::shoot;
pub use mask::Mask;
pub use plain::{End, cast, shoot_plainly};
pub use shot::{Emitter, Outgoing, Shot};
pub use trace::{Record, trace};
pub use work::{Operation, Work};
