//! Recorded runs as compressed blocks of data, which the page's program reads. Times are in nanoseconds.

/// The blocks of a page and their index.
mod blocks;
/// Which runs a page has room for.
mod budget;
/// A block: columns of numbers, compressed.
mod columns;
/// Numbers of emitters in a run.
mod emitters;
/// The block of a scene: patches and local environments.
mod geometry;
/// Where the nodes of a run are on its machine.
mod machine_layout;
/// The block of a run: spans, messages, critical path.
mod run;
/// The block of shots: what each of them hits.
mod shots;

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
