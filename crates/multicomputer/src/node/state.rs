//! The state of one node of a running machine.

use std::cell::{Cell, RefCell};
use std::mem;

use desim::{Handle, Signal, Time};

use super::account::{Activity, Ledger, NodeAccount};
use super::buffers::Buffers;
use super::coprocessor::Coprocessor;
use super::envelope::{Envelope, Rank};
use super::memory::{NodeMemory, ResidentSet};
use crate::network::Place;

/// The state of a node.
pub(crate) struct NodeState<M> {
    pub(crate) place: Place,
    pub(crate) ledger: RefCell<Ledger>,
    /// Messages that have arrived and were not read, in order of arrival.
    pub(crate) mailbox: RefCell<Vec<M>>,
    /// Their bytes.
    unread_bytes: Cell<u64>,
    /// The contents of its memory; none where memory is not modelled.
    pub(crate) memory: Option<RefCell<ResidentSet>>,
    /// A message has arrived.
    pub(crate) mail: Signal,
    /// Whether the process waits for a message: a receive is posted.
    pub(crate) posted: Cell<bool>,
    /// The messages in the mailbox that arrived while no receive was posted.
    pub(crate) unposted: Cell<Unposted>,
    /// None if they are unlimited.
    pub(crate) buffers: Option<RefCell<Buffers<Sender<M>>>>,
    /// The activity of a processor that waits for room in them.
    pub(crate) waiting: Activity,
    /// Senders that waited for room here have it now.
    pub(crate) room: Signal,
    /// The rank in whose buffers this node's processor waits for room.
    pub(crate) waits_for: Cell<Option<Rank>>,
    pub(crate) coprocessor: RefCell<Coprocessor<M>>,
}

/// Messages for which no receive was posted.
#[derive(Clone, Copy, Default)]
pub(crate) struct Unposted {
    pub(crate) messages: u64,
    pub(crate) bytes: u64,
}

/// A sender that waits for room in buffers.
pub(crate) enum Sender<M> {
    /// A processor.
    Processor(Rank),
    /// The coprocessor of the message's sender.
    Coprocessor(Envelope<M>),
}

impl<M> NodeState<M> {
    /// The state of a node at the start. Its buffers have `room` bytes, or are unlimited; `waiting` is
    /// the activity of a processor that waits for room in them.
    pub(crate) fn new(
        handle: &Handle,
        rank: Rank,
        place: Place,
        memory: Option<&NodeMemory>,
        (room, waiting): (Option<u64>, Activity),
    ) -> NodeState<M> {
        NodeState {
            place,
            ledger: RefCell::default(),
            mailbox: RefCell::default(),
            unread_bytes: Cell::default(),
            memory: memory.map(|memory| RefCell::new(ResidentSet::new(memory))),
            mail: Signal::new(handle, format!("mail at node {rank}")),
            posted: Cell::default(),
            unposted: Cell::default(),
            buffers: room.map(|bytes| RefCell::new(Buffers::new(bytes))),
            waiting,
            room: Signal::new(handle, format!("room in the buffers of node {rank}")),
            waits_for: Cell::default(),
            coprocessor: RefCell::new(Coprocessor::new()),
        }
    }

    /// The node's account until `now`.
    pub(crate) fn account(&self, now: Time) -> NodeAccount {
        let mut account = self.ledger.borrow_mut().account(now);
        account.memory_high_water = self.memory.as_ref().map(|m| m.borrow().high_water());
        account.layer.buffer_bytes_most = self.buffers.as_ref().map_or(0, |b| b.borrow().most());
        account
    }

    /// Takes all messages out of the mailbox.
    pub(crate) fn take_mail(&self) -> Vec<M> {
        self.set_unread(0);
        mem::take(&mut *self.mailbox.borrow_mut())
    }

    /// Puts a message into the mailbox. Returns whether a receive was posted for it.
    pub(crate) fn put_mail(&self, message: M, bytes: u64) -> bool {
        self.mailbox.borrow_mut().push(message);
        self.set_unread(self.unread_bytes.get().saturating_add(bytes));
        self.mail.notify();
        let posted = self.posted.take();
        if !posted {
            let Unposted { messages, bytes: earlier } = self.unposted.get();
            let bytes = earlier.saturating_add(bytes);
            self.unposted.set(Unposted { messages: messages + 1, bytes });
        }
        posted
    }

    fn set_unread(&self, bytes: u64) {
        self.unread_bytes.set(bytes);
        self.memory.iter().for_each(|memory| memory.borrow_mut().set_unread(bytes));
    }
}
