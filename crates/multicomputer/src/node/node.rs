//! A node's interface for the process that runs on it: compute, send, receive, wait.

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Handle, Signal, Time};

use super::account::Activity;
use super::envelope::{Envelope, Rank};
use super::full_buffers::FullBuffers;
use super::memory::{ResidentSet, Segment};
use super::shared::Shared;
use super::state::{NodeState, Sender};

/// A node of a running [`crate::Multicomputer`]. Clones are the same node.
pub struct Node<M> {
    rank: Rank,
    shared: Rc<Shared<M>>,
}

impl<M> Clone for Node<M> {
    fn clone(&self) -> Node<M> {
        Node { rank: self.rank, shared: self.shared.clone() }
    }
}

impl<M: 'static> Node<M> {
    pub(crate) fn new(rank: Rank, shared: Rc<Shared<M>>) -> Node<M> {
        Node { rank, shared }
    }

    /// The rank of the process on this node.
    pub fn rank(&self) -> Rank {
        self.rank
    }

    /// The present virtual time.
    pub fn now(&self) -> Time {
        self.shared.handle.now()
    }

    /// Keeps the processor busy for a span.
    pub async fn compute(&self, span: Duration) {
        self.busy(Activity::Compute, self.now() + span).await;
    }

    /// Sends a message; returns when the processor is free. Without a coprocessor the processor waits
    /// for room in the receiver's buffers, makes packets, and is busy for the send overhead. With a
    /// coprocessor it only hands the message over.
    ///
    /// # Panics
    /// When no process has the rank `to`.
    pub async fn send(&self, to: Rank, bytes: u64, message: M) {
        let envelope = Envelope { from: self.rank, to, bytes, message };
        let layer = &self.shared.layer;
        if let Some(handover) = layer.handover {
            self.busy(Activity::Send, self.now() + handover).await;
            self.state().ledger.borrow_mut().sent(bytes);
            return self.shared.hand_over(envelope);
        }
        self.wait_for_room(to, bytes).await;
        let packing = layer.packing(bytes);
        if packing > Duration::ZERO {
            self.busy(Activity::Pack, self.now() + packing).await;
        }
        let sender_free = self.shared.inject(envelope);
        self.state().ledger.borrow_mut().sent(bytes);
        self.busy(Activity::Send, sender_free).await;
    }

    /// Takes room for a message in the receiver's buffers; waits until there is enough.
    async fn wait_for_room(&self, to: Rank, bytes: u64) {
        let (sender, receiver) = (self.state(), &self.shared.nodes[to]);
        let Some(buffers) = &receiver.buffers else { return };
        if buffers.borrow_mut().try_take(bytes) {
            return;
        }
        buffers.borrow_mut().queue(bytes, Sender::Processor(self.rank));
        sender.waits_for.set(Some(to));
        let waits_for = |rank: Rank| self.shared.nodes[rank].waits_for.get();
        if let Some(full) = FullBuffers::find(self.rank, waits_for) {
            self.shared.handle.halt(full.to_string());
            *self.shared.full_buffers.borrow_mut() = Some(full);
        }
        sender.ledger.borrow_mut().held();
        sender.ledger.borrow_mut().turn_to(receiver.waiting, self.now());
        while sender.waits_for.get().is_some() {
            receiver.room.wait().await;
        }
        sender.ledger.borrow_mut().turn_to(Activity::Idle, self.now());
    }

    /// Reads the messages that have arrived, in order of arrival. The processor is busy for the
    /// receive overhead of each message, and copies those for which no receive was posted. What
    /// arrives meanwhile is left for the next call. Returns at once when nothing has arrived.
    pub async fn received(&self) -> Vec<M> {
        let (node, layer) = (self.state(), &self.shared.layer);
        let messages = node.take_mail();
        if !messages.is_empty() {
            self.shared
                .notify_observer(|observer| observer.read(self.now(), self.rank, messages.len()));
            let (count, unposted) = (messages.len() as u64, node.unposted.take());
            let overhead = || self.shared.transport.borrow().network.receive_overhead();
            let overhead = layer.handover.unwrap_or_else(overhead);
            node.ledger.borrow_mut().received(count, unposted.messages);
            self.busy(Activity::Receive, self.now() + overhead * count).await;
            let copying = layer.copying(unposted.bytes);
            if copying > Duration::ZERO {
                self.busy(Activity::Copy, self.now() + copying).await;
            }
            self.shared.release(self.rank, unposted.bytes);
        }
        messages
    }

    /// Whether a message has arrived and was not read.
    pub fn has_mail(&self) -> bool {
        !self.state().mailbox.borrow().is_empty()
    }

    /// Waits until a message has arrived and was not read. A receive is posted meanwhile, so that the
    /// first message to arrive needs no copy.
    pub async fn wait(&self) {
        while !self.has_mail() {
            self.state().posted.set(true);
            self.state().mail.wait().await;
        }
    }

    /// Like [`Node::wait`], until `time` at the latest. Returns whether there is a message to read.
    pub async fn wait_until(&self, time: Time) -> bool {
        while !self.has_mail() {
            self.state().posted.set(true);
            if !self.state().mail.wait_until(time).await {
                self.state().posted.set(false);
                return self.has_mail();
            }
        }
        true
    }

    /// The program allocates a segment of memory.
    pub fn keep(&self, segment: Segment, bytes: u64) {
        self.memory().for_each(|memory| memory.borrow_mut().keep(segment, bytes));
    }

    /// The program uses segments, one after the other. The processor waits for those that are not
    /// resident, where memory is modelled.
    pub async fn touch(&self, segments: impl IntoIterator<Item = Segment>) {
        let Some(memory) = self.memory().next() else { return };
        let wait = |segment| memory.borrow_mut().touch(segment);
        let span: Duration = segments.into_iter().map(wait).sum();
        if span > Duration::ZERO {
            self.busy(Activity::Paging, self.now() + span).await;
        }
    }

    /// The program frees a segment.
    pub fn release(&self, segment: Segment) {
        self.memory().for_each(|memory| memory.borrow_mut().release(segment));
    }

    /// Bytes that the program has allocated, resident or paged out; 0 where memory is not modelled.
    pub fn bytes_kept(&self) -> u64 {
        self.memory().map(|memory| memory.borrow().allocated_bytes()).sum()
    }

    fn memory(&self) -> impl Iterator<Item = &RefCell<ResidentSet>> {
        self.state().memory.iter()
    }

    /// Ends the node's life: its account closes at the present time, and senders no longer wait for
    /// room in its buffers.
    pub fn finish(&self) {
        self.state().ledger.borrow_mut().finish(self.now());
        self.shared.open(self.rank);
    }

    fn state(&self) -> &NodeState<M> {
        &self.shared.nodes[self.rank]
    }

    /// Waits for a signal; the time is entered as `activity`.
    pub(crate) async fn wait_in(&self, activity: Activity, signal: &Signal) {
        self.state().ledger.borrow_mut().turn_to(activity, self.now());
        signal.wait().await;
        self.state().ledger.borrow_mut().turn_to(Activity::Idle, self.now());
    }

    /// The simulation in which it runs.
    pub(crate) fn handle(&self) -> &Handle {
        &self.shared.handle
    }

    /// Waits until `end`; the time is entered as `activity`, and what follows as idle.
    pub(crate) async fn busy(&self, activity: Activity, end: Time) {
        self.state().ledger.borrow_mut().turn_to(activity, self.now());
        self.shared.handle.sleep_until(end).await;
        self.state().ledger.borrow_mut().turn_to(Activity::Idle, self.now());
    }
}
