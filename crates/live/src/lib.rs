//! A page served to browsers, and what it hears of runs that are under way.
//!
//! Whoever makes the runs puts what happens on a [`Board`] and goes on; every viewer reads the board at
//! its own pace, so that none can hold up a run, or another viewer. A [`Server`] has one page, its
//! files and its stream of updates, and nothing else. Knows nothing of what runs are and pages show.

mod board;
mod host;
mod reader;
mod server;
mod stream;

pub use board::Board;
pub use server::{Server, Site};
