//! What every name means: columns of results, fields of files, choices, network models.

pub mod choices; // The choices that the code makes where the paper is silent.
pub mod entries; // All of them, and the one that a word means.
pub mod entry; // A name and what it means.
pub mod fields; // The fields of experiment, machine and scene files.
