//! A node as the process that runs on it sees it: compute, send, receive, wait.

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Handle, Signal, Time};

use super::account::Activity;
use super::buffers::{FullBuffers, Rank};
use super::memory::{Residence, Segment};
use super::shared::{Letter, NodeState, Shared, Waiting};

/// A node of a running [`crate::Multicomputer`]; cheap to clone and to move into its process.
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

    /// Sends a message. The processor is busy with it until the send overhead is over, and then goes
    /// on; the message travels by itself. With a coprocessor that has nothing to do with it but to hand
    /// it over; without one, it first waits for room in the receiver's buffers and makes packets.
    ///
    /// # Panics
    /// When no process has the rank `to`.
    pub async fn send(&self, to: Rank, bytes: u64, message: M) {
        let letter = Letter { from: self.rank, to, bytes, message };
        let layer = &self.shared.layer;
        if let Some(handover) = layer.handover {
            self.busy(Activity::Send, self.now() + handover).await;
            self.state().ledger.borrow_mut().sent(bytes);
            return self.shared.hand_over(letter);
        }
        self.wait_for_room(to, bytes).await;
        let packing = layer.packing(bytes);
        if packing > Duration::ZERO {
            self.busy(Activity::Pack, self.now() + packing).await;
        }
        let sender_free = self.shared.inject(letter);
        self.state().ledger.borrow_mut().sent(bytes);
        self.busy(Activity::Send, sender_free).await;
    }

    /// Waits until a message of so many bytes finds room in the receiver's buffers, and takes it.
    async fn wait_for_room(&self, to: Rank, bytes: u64) {
        let (sender, receiver) = (self.state(), &self.shared.nodes[to]);
        let Some(buffers) = &receiver.buffers else { return };
        if buffers.borrow_mut().try_take(bytes) {
            return;
        }
        buffers.borrow_mut().queue(bytes, Waiting::Processor(self.rank));
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

    /// Takes what has arrived, in order of arrival. The processor is busy for the receive overhead
    /// of each message, and with copying those for which no receive was posted; what arrives
    /// meanwhile is left for the next call. Returns at once when nothing has arrived.
    pub async fn received(&self) -> Vec<M> {
        let (node, layer) = (self.state(), &self.shared.layer);
        let messages = node.take_mail();
        if !messages.is_empty() {
            self.shared.tell(|observer| observer.read(self.now(), self.rank, messages.len()));
            let (count, unposted) = (messages.len() as u64, node.unposted.take());
            let overhead = || self.shared.wires.borrow().network.receive_overhead();
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

    /// Whether something has arrived and was not taken.
    pub fn has_mail(&self) -> bool {
        !self.state().mailbox.borrow().is_empty()
    }

    /// Idle until something has arrived and was not taken; returns at once if that is so now. A
    /// receive is posted meanwhile, so that the first message to arrive needs no copy.
    pub async fn wait(&self) {
        while !self.has_mail() {
            self.state().posted.set(true);
            self.state().mail.wait().await;
        }
    }

    /// Like [`Node::wait`], at most until `time`; says whether there is mail.
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

    /// The program makes something that it keeps in memory.
    pub fn keep(&self, segment: Segment, bytes: u64) {
        self.residence().for_each(|residence| residence.borrow_mut().keep(segment, bytes));
    }

    /// The program uses segments, one after the other. Where memory is modelled and one of them is
    /// not resident, the processor waits until it is.
    pub async fn touch(&self, segments: impl IntoIterator<Item = Segment>) {
        let Some(residence) = self.residence().next() else { return };
        let wait = |segment| residence.borrow_mut().touch(segment);
        let span: Duration = segments.into_iter().map(wait).sum();
        if span > Duration::ZERO {
            self.busy(Activity::Paging, self.now() + span).await;
        }
    }

    /// The program needs something no more that it kept in memory.
    pub fn release(&self, segment: Segment) {
        self.residence().for_each(|residence| residence.borrow_mut().release(segment));
    }

    /// Bytes that the program keeps, in memory or paged out; 0 where memory is not modelled.
    pub fn bytes_kept(&self) -> u64 {
        self.residence().map(|residence| residence.borrow().held_bytes()).sum()
    }

    fn residence(&self) -> impl Iterator<Item = &RefCell<Residence>> {
        self.state().residence.iter()
    }

    /// The node's work is done: its account closes at the present time, and nobody waits for room in
    /// its buffers any more.
    pub fn finish(&self) {
        self.state().ledger.borrow_mut().finish(self.now());
        self.shared.open(self.rank);
    }

    fn state(&self) -> &NodeState<M> {
        &self.shared.nodes[self.rank]
    }

    /// Waits for a signal, which goes to `activity`.
    pub(crate) async fn wait_in(&self, activity: Activity, signal: &Signal) {
        self.state().ledger.borrow_mut().turn_to(activity, self.now());
        signal.wait().await;
        self.state().ledger.borrow_mut().turn_to(Activity::Idle, self.now());
    }

    /// The simulation that it runs in.
    pub(crate) fn handle(&self) -> &Handle {
        &self.shared.handle
    }

    /// Time until `end` goes to `activity`, and what follows to idleness until further notice.
    pub(crate) async fn busy(&self, activity: Activity, end: Time) {
        self.state().ledger.borrow_mut().turn_to(activity, self.now());
        self.shared.handle.sleep_until(end).await;
        self.state().ledger.borrow_mut().turn_to(Activity::Idle, self.now());
    }
}
