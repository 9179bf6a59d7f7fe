//! Recorded runs as compressed blocks of data, which the page's program reads. Times are in nanoseconds.

mod blocks; // the blocks of a page and their index
mod budget; // which runs a page has room for
mod columns; // a block: columns of numbers, compressed
mod emitters; // numbers of emitters in a run
mod geometry; // the block of a scene: patches and local environments
mod machine_layout; // where the nodes of a run are on its machine
mod run; // the block of a run: spans, messages, critical path
mod shots; // the block of shots: what each of them hits

pub(crate) use blocks::Blocks;
pub(crate) use columns::Columns;
#[cfg(test)]
pub(crate) use columns::Reader;
pub(crate) use emitters::Emitters;
pub(crate) use geometry::geometry;
pub(crate) use machine_layout::machine_layout;
#[cfg(test)]
pub(crate) use run::shown_spans;
pub(crate) use run::{MessageRow, message_columns, nanoseconds};
pub(crate) use shots::{fine_unit, shot_columns};
