//! The buffers of a node for messages that were sent to it and not read.

use std::collections::VecDeque;
use std::error::Error;
use std::fmt;

/// Number of a process, from 0.
pub type Rank = usize;

/// A node's buffers, and who waits for room in them, first come, first served. Room is taken when a
/// message is sent, so that what is under way finds it.
pub(crate) struct Buffers<W> {
    /// Bytes; without end once nothing is read any more.
    capacity: u64,
    used: u64,
    most: u64,
    queue: VecDeque<(u64, W)>,
}

impl<W> Buffers<W> {
    pub(crate) fn new(capacity: u64) -> Buffers<W> {
        Buffers { capacity, used: 0, most: 0, queue: VecDeque::new() }
    }

    /// A message that is longer than the buffers has them to itself.
    fn has_room(&self, bytes: u64) -> bool {
        self.used == 0 || self.used.saturating_add(bytes) <= self.capacity
    }

    fn take(&mut self, bytes: u64) {
        self.used = self.used.saturating_add(bytes);
        self.most = self.most.max(self.used);
    }

    /// Takes room for a message, if there is enough and nobody waits for some.
    pub(crate) fn try_take(&mut self, bytes: u64) -> bool {
        let takes = self.queue.is_empty() && self.has_room(bytes);
        if takes {
            self.take(bytes);
        }
        takes
    }

    /// Waits in line for room.
    pub(crate) fn queue(&mut self, bytes: u64, who: W) {
        self.queue.push_back((bytes, who));
    }

    /// Messages have left; those of the line that now have room are returned.
    pub(crate) fn release(&mut self, bytes: u64) -> Vec<W> {
        self.used = self.used.saturating_sub(bytes);
        let mut served = Vec::new();
        while self.queue.front().is_some_and(|&(bytes, _)| self.has_room(bytes)) {
            let Some((bytes, who)) = self.queue.pop_front() else { break };
            self.take(bytes);
            served.push(who);
        }
        served
    }

    /// Nothing that is sent here will be read: there is always room from now on.
    pub(crate) fn open(&mut self) -> Vec<W> {
        self.capacity = u64::MAX;
        self.release(0)
    }

    /// The most bytes that have been in use.
    pub(crate) fn most(&self) -> u64 {
        self.most
    }
}

/// Processes that all wait for room in the buffers of the next one, and so never read what is in
/// their own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FullBuffers {
    /// Their ranks; the last one waits for the first.
    pub circle: Vec<Rank>,
}

impl FullBuffers {
    /// The circle that closes when `sender` begins to wait, if one does: `waits_for` says for whose
    /// buffers a process waits.
    pub(crate) fn find(
        sender: Rank,
        waits_for: impl Fn(Rank) -> Option<Rank>,
    ) -> Option<FullBuffers> {
        let mut circle = vec![sender];
        let mut here = waits_for(sender)?;
        while here != sender {
            circle.push(here);
            here = waits_for(here)?;
        }
        Some(FullBuffers { circle })
    }
}

impl fmt::Display for FullBuffers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let [rank] = self.circle[..] {
            return write!(f, "deadlock by full buffers: node {rank} waits for room in its own");
        }
        let ranks: Vec<String> = self.circle.iter().map(Rank::to_string).collect();
        let ranks = ranks.join(", ");
        write!(
            f,
            "deadlock by full buffers: each of the nodes {ranks} waits for room in those of the "
        )?;
        f.write_str("next, and the last in those of the first")
    }
}

impl Error for FullBuffers {}
