//! A node's buffers for messages that were sent to it and not read.

use std::collections::VecDeque;

/// Buffers, and the senders that wait for room in them, first come, first served. Room is taken when a
/// message is sent, so that a message in flight always finds it.
pub(crate) struct Buffers<W> {
    /// Bytes; unlimited after [`Buffers::open`].
    capacity: u64,
    used: u64,
    most: u64,
    queue: VecDeque<(u64, W)>,
}

impl<W> Buffers<W> {
    pub(crate) fn new(capacity: u64) -> Buffers<W> {
        Buffers { capacity, used: 0, most: 0, queue: VecDeque::new() }
    }

    /// A message longer than the buffers fits if they are empty.
    fn has_room(&self, bytes: u64) -> bool {
        self.used == 0 || self.used.saturating_add(bytes) <= self.capacity
    }

    fn take(&mut self, bytes: u64) {
        self.used = self.used.saturating_add(bytes);
        self.most = self.most.max(self.used);
    }

    /// Takes room for a message, if there is enough and no other sender waits.
    pub(crate) fn try_take(&mut self, bytes: u64) -> bool {
        let takes = self.queue.is_empty() && self.has_room(bytes);
        if takes {
            self.take(bytes);
        }
        takes
    }

    /// Queues a sender that waits for room.
    pub(crate) fn queue(&mut self, bytes: u64, sender: W) {
        self.queue.push_back((bytes, sender));
    }

    /// Frees room. Returns the waiting senders that have room now.
    pub(crate) fn release(&mut self, bytes: u64) -> Vec<W> {
        self.used = self.used.saturating_sub(bytes);
        let mut served = Vec::new();
        while self.queue.front().is_some_and(|&(bytes, _)| self.has_room(bytes)) {
            let Some((bytes, sender)) = self.queue.pop_front() else { break };
            self.take(bytes);
            served.push(sender);
        }
        served
    }

    /// Removes the limit: the node has finished and reads nothing more. Returns the waiting senders.
    pub(crate) fn open(&mut self) -> Vec<W> {
        self.capacity = u64::MAX;
        self.release(0)
    }

    /// The most bytes in use at a time.
    pub(crate) fn most(&self) -> u64 {
        self.most
    }
}
