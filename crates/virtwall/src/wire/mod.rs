//! The messages between processes, and their bytes.

mod kind;
mod message;
mod reader;
mod source;
mod wall_patch;
mod words;

pub use kind::MessageKind;
pub use message::{Message, PatchUpdate, Sums};
pub use reader::DecodeError;
pub(crate) use reader::Reader;
pub(crate) use words::little_endian;
