//! A node as the process that runs on it sees it: compute, send, receive, wait.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::mem;
use std::rc::Rc;

use desim::{Alarm, Duration, Handle, Signal, Time};

use crate::account::{Activity, Ledger, NodeAccount};
use crate::memory::{NodeMemory, Residence, Segment};
use crate::network::{Arrival, Deadlock, Message, Network};
use crate::topology::Place;

/// Number of a process, from 0.
pub type Rank = usize;

/// A node of a running [`crate::Multicomputer`]; cheap to clone and to move into its process.
pub struct Node<M> {
    rank: Rank,
    shared: Rc<Shared<M>>,
}

/// What all nodes of a multicomputer share.
pub(crate) struct Shared<M> {
    pub(crate) handle: Handle,
    pub(crate) wires: RefCell<Wires<M>>,
    /// Goes off when the network has something to do.
    pub(crate) news: Alarm,
    pub(crate) nodes: Vec<NodeState<M>>,
}

/// The network, and what is under way on it.
pub(crate) struct Wires<M> {
    pub(crate) network: Box<dyn Network>,
    /// Messages under way with the ranks they go to, and some that have arrived: in the order in
    /// which they were sent, so that the network may know each by a number of its own.
    under_way: VecDeque<Option<(Rank, M)>>,
    /// The number of the first of them.
    first: u64,
    arrived: Vec<Arrival>,
    /// The messages that will never arrive.
    pub(crate) deadlock: Option<Deadlock>,
}

impl<M> Wires<M> {
    pub(crate) fn new(network: Box<dyn Network>) -> Wires<M> {
        let (under_way, arrived) = (VecDeque::new(), Vec::new());
        Wires { network, under_way, first: 0, arrived, deadlock: None }
    }

    /// Sends a message; returns when the sending processor may go on.
    fn send(&mut self, now: Time, ends: (Place, Place), bytes: u64, letter: (Rank, M)) -> Time {
        let id = self.first + self.under_way.len() as u64;
        self.under_way.push_back(Some(letter));
        let (from, to) = ends;
        self.network.send(now, Message { id, from, to, bytes })
    }

    /// Hands over a message that has arrived.
    fn take(&mut self, id: u64) -> Option<(Rank, M)> {
        let letter = self.under_way.get_mut(id.checked_sub(self.first)? as usize)?.take();
        while let Some(None) = self.under_way.front() {
            self.under_way.pop_front();
            self.first += 1;
        }
        letter
    }
}

impl<M> Shared<M> {
    /// The network goes on until now; what has arrived is put into mailboxes.
    pub(crate) fn advance(&self) {
        let mut wires = self.wires.borrow_mut();
        let mut arrived = mem::take(&mut wires.arrived);
        if let Err(deadlock) = wires.network.advance(self.handle.now(), &mut arrived) {
            self.handle.halt(deadlock.to_string());
            wires.deadlock = Some(deadlock);
        }
        for arrival in arrived.drain(..) {
            if let Some((to, message)) = wires.take(arrival.message.id) {
                self.nodes[to].arrive(message, arrival.message.bytes);
            }
        }
        wires.arrived = arrived;
        self.expect_news(&wires);
    }

    fn expect_news(&self, wires: &Wires<M>) {
        if let Some(time) = wires.network.next_event() {
            self.news.set(time);
        }
    }
}

/// What a multicomputer keeps for a node.
pub(crate) struct NodeState<M> {
    place: Place,
    ledger: RefCell<Ledger>,
    /// Messages that have arrived and were not taken, in order of arrival.
    mailbox: RefCell<Vec<M>>,
    /// Their bytes.
    unread_bytes: Cell<u64>,
    /// What its memory holds, where memory is modelled.
    residence: Option<RefCell<Residence>>,
    mail: Signal,
}

impl<M> NodeState<M> {
    pub(crate) fn new(
        handle: &Handle,
        rank: Rank,
        place: Place,
        memory: Option<&NodeMemory>,
    ) -> NodeState<M> {
        NodeState {
            place,
            ledger: RefCell::default(),
            mailbox: RefCell::default(),
            unread_bytes: Cell::new(0),
            residence: memory.map(|memory| RefCell::new(Residence::new(memory))),
            mail: Signal::new(handle, format!("mail at node {rank}")),
        }
    }

    /// The node's account until `now`.
    pub(crate) fn account(&self, now: Time) -> NodeAccount {
        let memory_high_water = self.residence.as_ref().map(|r| r.borrow().high_water());
        NodeAccount { memory_high_water, ..self.ledger.borrow_mut().account(now) }
    }

    fn arrive(&self, message: M, bytes: u64) {
        self.mailbox.borrow_mut().push(message);
        self.set_unread(self.unread_bytes.get().saturating_add(bytes));
        self.mail.notify();
    }

    fn set_unread(&self, bytes: u64) {
        self.unread_bytes.set(bytes);
        self.residence.iter().for_each(|residence| residence.borrow_mut().set_unread(bytes));
    }
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

    /// Sends a message. The processor is busy with it for the send overhead and then goes on; the
    /// message travels by itself.
    ///
    /// # Panics
    /// When no process has the rank `to`.
    pub async fn send(&self, to: Rank, bytes: u64, message: M) {
        let (from, receiver) = (self.state(), &self.shared.nodes[to]);
        let sender_free = {
            let mut wires = self.shared.wires.borrow_mut();
            let ends = (from.place, receiver.place);
            let sender_free = wires.send(self.now(), ends, bytes, (to, message));
            self.shared.expect_news(&wires);
            sender_free
        };
        from.ledger.borrow_mut().sent(bytes);
        self.busy(Activity::Send, sender_free).await;
    }

    /// Takes what has arrived, in order of arrival. The processor is busy for the receive overhead
    /// of each message; what arrives meanwhile is left for the next call. Returns at once when
    /// nothing has arrived.
    pub async fn received(&self) -> Vec<M> {
        let messages = mem::take(&mut *self.state().mailbox.borrow_mut());
        self.state().set_unread(0);
        if !messages.is_empty() {
            let count = messages.len() as u64;
            let overhead = self.shared.wires.borrow().network.receive_overhead();
            self.state().ledger.borrow_mut().received(count);
            self.busy(Activity::Receive, self.now() + overhead * count).await;
        }
        messages
    }

    /// Whether something has arrived and was not taken.
    pub fn has_mail(&self) -> bool {
        !self.state().mailbox.borrow().is_empty()
    }

    /// Idle until something has arrived and was not taken; returns at once if that is so now.
    pub async fn wait(&self) {
        while !self.has_mail() {
            self.state().mail.wait().await;
        }
    }

    /// Like [`Node::wait`], at most until `time`; says whether there is mail.
    pub async fn wait_until(&self, time: Time) -> bool {
        while !self.has_mail() {
            if !self.state().mail.wait_until(time).await {
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

    fn residence(&self) -> impl Iterator<Item = &RefCell<Residence>> {
        self.state().residence.iter()
    }

    /// The node's work is done: its account closes at the present time.
    pub fn finish(&self) {
        self.state().ledger.borrow_mut().finish(self.now());
    }

    fn state(&self) -> &NodeState<M> {
        &self.shared.nodes[self.rank]
    }

    /// Time until `end` goes to `activity`, and what follows to idleness until further notice.
    async fn busy(&self, activity: Activity, end: Time) {
        self.state().ledger.borrow_mut().turn_to(activity, self.now());
        self.shared.handle.sleep_until(end).await;
        self.state().ledger.borrow_mut().turn_to(Activity::Idle, self.now());
    }
}
