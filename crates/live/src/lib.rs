//! A web server for a page that follows runs while they are under way.
//!
//! The simulation writes what happens to a [`Board`] and goes on. Every viewer reads the board at its own
//! pace, so none can delay a run or another viewer. A [`Server`] has one page, its files and its stream
//! of server-sent events.

/// What has happened in the runs so far.
mod board;
/// Whether a request is addressed to this host.
mod host;
/// One viewer's position on the board.
mod reader;
/// Listening and answering.
mod server;
/// The stream of server-sent events.
mod stream;

pub use board::Board;
pub use server::{Server, Site};
