//! A web server for a page that follows runs while they are under way.
//!
//! The simulation writes what happens to a [`Board`] and goes on. Every viewer reads the board at its own
//! pace, so none can delay a run or another viewer. A server ([`serve`]) has one page, its files and its stream
//! of server-sent events.

mod answer; // status, headers and body; the connection's end
mod board; // what has happened in the runs so far
mod deadline; // reading until a deadline
mod host; // whether a request is addressed to this host
mod reader; // one viewer's position on the board
mod request; // reading a request, with limits
mod server; // listening and answering
mod stream; // the stream of server-sent events

pub use board::Board;
pub use server::{Site, serve};
