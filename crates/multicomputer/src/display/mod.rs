//! From the service node to a display: frames, Ethernet, back pressure.

/// A display and the way to it.
mod display;
/// A medium that carries one frame at a time.
mod ethernet;
/// The service node's end of the connection.
mod socket;

pub(crate) use display::DisplayFile;
pub use display::{Display, WhenFull};
pub use ethernet::Ethernet;
pub use socket::{DisplayAccount, Socket};
