//! From the service node to a display: frames, Ethernet, back pressure.

mod display; // a display and the way to it
mod ethernet; // a medium that carries one frame at a time
mod socket; // the service node's end of the connection

pub(crate) use display::DisplayFile;
pub use display::{Display, WhenFull};
pub use ethernet::Ethernet;
pub use socket::{DisplayAccount, Socket};
