//! A message with its sender, its receiver and its length.

/// Number of a process, from 0.
pub type Rank = usize;

/// A message on its way from process to process.
pub(crate) struct Envelope<M> {
    pub(crate) from: Rank,
    pub(crate) to: Rank,
    pub(crate) bytes: u64,
    pub(crate) message: M,
}
