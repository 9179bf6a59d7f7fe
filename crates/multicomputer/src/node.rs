//! A node as the process that runs on it sees it: compute, send, receive, wait.

use std::cell::RefCell;
use std::mem;
use std::rc::Rc;

use desim::{Duration, Handle, Signal, Time};

use crate::account::{Activity, Ledger};
use crate::mesh::Place;
use crate::network::Network;

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
    pub(crate) network: RefCell<Box<dyn Network>>,
    pub(crate) nodes: Vec<NodeState<M>>,
}

/// What a multicomputer keeps for a node.
pub(crate) struct NodeState<M> {
    place: Place,
    pub(crate) ledger: RefCell<Ledger>,
    /// Messages that have arrived and were not taken, in order of arrival.
    mailbox: RefCell<Vec<M>>,
    mail: Signal,
}

impl<M> NodeState<M> {
    pub(crate) fn new(handle: &Handle, rank: Rank, place: Place) -> NodeState<M> {
        let mail = Signal::new(handle, format!("mail at node {rank}"));
        NodeState { place, ledger: RefCell::default(), mailbox: RefCell::default(), mail }
    }

    fn arrive(&self, message: M) {
        self.mailbox.borrow_mut().push(message);
        self.mail.notify();
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
        let shared = self.shared.clone();
        let (from, receiver) = (self.state(), &shared.nodes[to]);
        let delivery =
            shared.network.borrow_mut().deliver(self.now(), from.place, receiver.place, bytes);
        from.ledger.borrow_mut().sent(bytes);
        let post = shared.clone();
        shared.handle.at(delivery.arrives, move || post.nodes[to].arrive(message));
        self.busy(Activity::Send, delivery.sender_free).await;
    }

    /// Takes what has arrived, in order of arrival. The processor is busy for the receive overhead
    /// of each message; what arrives meanwhile is left for the next call. Returns at once when
    /// nothing has arrived.
    pub async fn received(&self) -> Vec<M> {
        let messages = mem::take(&mut *self.state().mailbox.borrow_mut());
        if !messages.is_empty() {
            let count = messages.len() as u64;
            let overhead = self.shared.network.borrow().receive_overhead();
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
