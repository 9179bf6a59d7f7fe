//! Shooting: the rays of an emitter through one local environment (§3.3, §4.2.3).

mod bundle; // 64 rays at a time: the parts of the fast path
mod dimmed; // shooting in a scene with participating media
mod directions; // sets of directions: Fibonacci, hemicube, polar, concentric
mod form_factors; // sums of the weights of pixels
mod hemisphere; // the directions of the rays over an emitter (§3.2)
mod kernel; // `shoot`, the fast path
mod mask; // the visibility mask (§3.2)
mod plain; // one ray at a time: the slow path that tests compare the fast path with
mod shot; // an emitter, and the result of its shot in one environment
mod trace; // the records that a shot reads and writes, for models of caches
mod work; // counts of operations, which a machine prices

pub(crate) use directions::unlifted;
pub use hemisphere::{Hemisphere, HemisphereError, HemisphereKind, MOST_PIXELS};
pub use kernel::shoot;
pub use mask::Mask;
pub use plain::{End, cast, shoot_plainly};
pub use shot::{Emitter, Outgoing, Shot};
pub use trace::{Record, trace};
pub use work::{Operation, Work};
