//! What all nodes of a running multicomputer share: the network, and what each node keeps for the
//! messages that come to it.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::VecDeque;
use std::mem;
use std::rc::Rc;

use desim::{Alarm, Handle, Signal, Time};

use super::account::{Activity, Ledger, NodeAccount};
use super::buffers::{Buffers, FullBuffers, Rank};
use super::memory::{NodeMemory, Residence};
use super::message_layer::MessageLayer;
use super::observer::{MachineObserver, Sent};
use crate::network::Place;
use crate::network::{Arrival, Deadlock, Message, Network};

/// What all nodes of a multicomputer share.
pub(crate) struct Shared<M> {
    pub(crate) handle: Handle,
    pub(crate) layer: MessageLayer,
    pub(crate) wires: RefCell<Wires<M>>,
    /// Goes off when the network has something to do.
    pub(crate) news: Alarm,
    pub(crate) nodes: Vec<NodeState<M>>,
    /// The processes that will never find room for a message.
    pub(crate) full_buffers: RefCell<Option<FullBuffers>>,
    pub(crate) observer: OnceCell<Rc<RefCell<dyn MachineObserver<M>>>>,
}

/// A message, and between which processes.
pub(crate) struct Letter<M> {
    pub(crate) from: Rank,
    pub(crate) to: Rank,
    pub(crate) bytes: u64,
    pub(crate) message: M,
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

    /// How many messages have been sent.
    fn sent(&self) -> u64 {
        self.first + self.under_way.len() as u64
    }

    /// Sends a message; returns when the sending processor may go on.
    fn send(&mut self, now: Time, (from, to): (Place, Place), letter: Letter<M>) -> Time {
        let id = self.sent();
        self.under_way.push_back(Some((letter.to, letter.message)));
        self.network.send(now, Message { id, from, to, bytes: letter.bytes })
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

/// What a multicomputer keeps for a node.
pub(crate) struct NodeState<M> {
    place: Place,
    pub(crate) ledger: RefCell<Ledger>,
    /// Messages that have arrived and were not taken, in order of arrival.
    pub(crate) mailbox: RefCell<Vec<M>>,
    /// Their bytes.
    unread_bytes: Cell<u64>,
    /// What its memory holds, where memory is modelled.
    pub(crate) residence: Option<RefCell<Residence>>,
    pub(crate) mail: Signal,
    /// Whether the process waits for mail: a receive is posted.
    pub(crate) posted: Cell<bool>,
    /// What of the mailbox came while no receive was posted.
    pub(crate) unposted: Cell<Unposted>,
    /// None if there is always room.
    pub(crate) buffers: Option<RefCell<Buffers<Waiting<M>>>>,
    /// What a processor does that waits for room in them.
    pub(crate) waiting: Activity,
    /// Those who waited for room here have it.
    pub(crate) room: Signal,
    /// In whose buffers the processor waits for room.
    pub(crate) waits_for: Cell<Option<Rank>>,
    coprocessor: RefCell<Coprocessor<M>>,
}

/// Messages for which no receive was posted.
#[derive(Clone, Copy, Default)]
pub(crate) struct Unposted {
    pub(crate) messages: u64,
    pub(crate) bytes: u64,
}

/// Who waits for room in buffers.
pub(crate) enum Waiting<M> {
    /// A processor, to send.
    Processor(Rank),
    /// A message that was handed to a coprocessor.
    Letter(Letter<M>),
}

/// A second processor that sends and receives, one message at a time, first come, first served.
struct Coprocessor<M> {
    jobs: VecDeque<Job<M>>,
    busy: bool,
}

enum Job<M> {
    Send(Letter<M>),
    /// Of so many bytes.
    Receive(u64, M),
}

impl<M> NodeState<M> {
    /// The state of a node at the start. Its buffers have `room` bytes, or are without end; a
    /// processor that waits for room in them does `waiting`.
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
            residence: memory.map(|memory| RefCell::new(Residence::new(memory))),
            mail: Signal::new(handle, format!("mail at node {rank}")),
            posted: Cell::default(),
            unposted: Cell::default(),
            buffers: room.map(|bytes| RefCell::new(Buffers::new(bytes))),
            waiting,
            room: Signal::new(handle, format!("room in the buffers of node {rank}")),
            waits_for: Cell::default(),
            coprocessor: RefCell::new(Coprocessor { jobs: VecDeque::new(), busy: false }),
        }
    }

    /// The node's account until `now`.
    pub(crate) fn account(&self, now: Time) -> NodeAccount {
        let mut account = self.ledger.borrow_mut().account(now);
        account.memory_high_water = self.residence.as_ref().map(|r| r.borrow().high_water());
        account.layer.buffer_bytes_most = self.buffers.as_ref().map_or(0, |b| b.borrow().most());
        account
    }

    /// Takes all messages out of the mailbox.
    pub(crate) fn take_mail(&self) -> Vec<M> {
        self.set_unread(0);
        mem::take(&mut *self.mailbox.borrow_mut())
    }

    fn put_mail(&self, message: M, bytes: u64) {
        self.mailbox.borrow_mut().push(message);
        self.set_unread(self.unread_bytes.get().saturating_add(bytes));
        self.mail.notify();
    }

    fn set_unread(&self, bytes: u64) {
        self.unread_bytes.set(bytes);
        self.residence.iter().for_each(|residence| residence.borrow_mut().set_unread(bytes));
    }
}

impl<M: 'static> Shared<M> {
    /// Puts a message on the network; returns when whoever sends it may go on.
    pub(crate) fn inject(&self, letter: Letter<M>) -> Time {
        let mut wires = self.wires.borrow_mut();
        let ends = (self.nodes[letter.from].place, self.nodes[letter.to].place);
        self.tell(|observer| {
            let Letter { from, to, bytes, ref message } = letter;
            let (number, handed_over) = (wires.sent(), self.layer.handover.is_some());
            let sent = Sent { number, from, to, bytes, handed_over, message };
            observer.sent(self.handle.now(), sent);
        });
        let sender_free = wires.send(self.handle.now(), ends, letter);
        self.expect_news(&wires);
        sender_free
    }

    /// The network goes on until now; what has arrived is put into mailboxes, or first received by
    /// coprocessors.
    pub(crate) fn advance(self: &Rc<Self>) {
        let mut wires = self.wires.borrow_mut();
        let mut arrived = mem::take(&mut wires.arrived);
        if let Err(deadlock) = wires.network.advance(self.handle.now(), &mut arrived) {
            self.handle.halt(deadlock.to_string());
            wires.deadlock = Some(deadlock);
        }
        drop(wires);
        for arrival in arrived.drain(..) {
            let Message { id, bytes, .. } = arrival.message;
            let letter = self.wires.borrow_mut().take(id);
            if let Some((to, _)) = letter {
                self.tell(|observer| observer.arrived(arrival.at, to, id, &arrival.stalls));
            }
            match letter {
                Some((to, message)) if self.layer.handover.is_some() => {
                    self.assign(to, Job::Receive(bytes, message));
                }
                Some((to, message)) => self.deliver(to, bytes, message),
                None => {}
            }
        }
        let mut wires = self.wires.borrow_mut();
        wires.arrived = arrived;
        self.expect_news(&wires);
    }

    /// Tells who observes this machine, if somebody does.
    pub(crate) fn tell(&self, news: impl FnOnce(&mut dyn MachineObserver<M>)) {
        if let Some(observer) = self.observer.get() {
            news(&mut *observer.borrow_mut());
        }
    }

    fn expect_news(&self, wires: &Wires<M>) {
        if let Some(time) = wires.network.next_event() {
            self.news.set(time);
        }
    }

    /// A message has come: into the hands of a process that waits for one, else into the buffers.
    fn deliver(self: &Rc<Self>, to: Rank, bytes: u64, message: M) {
        let node = &self.nodes[to];
        node.put_mail(message, bytes);
        if node.posted.take() {
            self.release(to, bytes);
        } else {
            let earlier = node.unposted.get();
            let bytes = earlier.bytes.saturating_add(bytes);
            node.unposted.set(Unposted { messages: earlier.messages + 1, bytes });
        }
    }

    /// So many bytes of a node's buffers are free again.
    pub(crate) fn release(self: &Rc<Self>, rank: Rank, bytes: u64) {
        if let Some(buffers) = &self.nodes[rank].buffers {
            let served = buffers.borrow_mut().release(bytes);
            self.go_on(rank, served);
        }
    }

    /// What is sent to a node from now on will not be read, and needs no room.
    pub(crate) fn open(self: &Rc<Self>, rank: Rank) {
        if let Some(buffers) = &self.nodes[rank].buffers {
            let served = buffers.borrow_mut().open();
            self.go_on(rank, served);
        }
    }

    /// Those who waited for room at a node have it.
    fn go_on(self: &Rc<Self>, rank: Rank, served: Vec<Waiting<M>>) {
        for waiting in served {
            match waiting {
                Waiting::Processor(sender) => self.nodes[sender].waits_for.set(None),
                Waiting::Letter(letter) => self.assign(letter.from, Job::Send(letter)),
            }
            self.nodes[rank].room.notify();
        }
    }

    /// Leaves a message to the sender's coprocessor, as soon as there is room for it.
    pub(crate) fn hand_over(self: &Rc<Self>, letter: Letter<M>) {
        if let Some(buffers) = &self.nodes[letter.to].buffers {
            let mut buffers = buffers.borrow_mut();
            if !buffers.try_take(letter.bytes) {
                self.nodes[letter.from].ledger.borrow_mut().held();
                return buffers.queue(letter.bytes, Waiting::Letter(letter));
            }
        }
        self.assign(letter.from, Job::Send(letter));
    }

    fn assign(self: &Rc<Self>, rank: Rank, job: Job<M>) {
        let mut coprocessor = self.nodes[rank].coprocessor.borrow_mut();
        coprocessor.jobs.push_back(job);
        if !coprocessor.busy {
            drop(coprocessor);
            self.next_job(rank);
        }
    }

    /// A node's coprocessor turns to its next message.
    fn next_job(self: &Rc<Self>, rank: Rank) {
        let mut coprocessor = self.nodes[rank].coprocessor.borrow_mut();
        let job = coprocessor.jobs.pop_front();
        coprocessor.busy = job.is_some();
        drop(coprocessor);
        let begin = self.handle.now();
        let done = move |shared: &Rc<Self>| {
            let span = shared.handle.now() - begin;
            shared.nodes[rank].ledger.borrow_mut().coprocessor(span);
            shared.next_job(rank);
        };
        match job {
            None => {}
            Some(Job::Send(letter)) => {
                self.at(begin + self.layer.packing(letter.bytes), move |shared| {
                    let free = shared.inject(letter);
                    shared.at(free, done);
                });
            }
            Some(Job::Receive(bytes, message)) => {
                let overhead = self.wires.borrow().network.receive_overhead();
                self.at(begin + overhead, move |shared| {
                    shared.deliver(rank, bytes, message);
                    done(shared);
                });
            }
        }
    }

    /// Does something at a time to come, unless all is over by then.
    fn at(self: &Rc<Self>, time: Time, action: impl FnOnce(&Rc<Self>) + 'static) {
        let shared = Rc::downgrade(self);
        self.handle.at(time, move || {
            if let Some(shared) = shared.upgrade() {
                action(&shared);
            }
        });
    }
}
