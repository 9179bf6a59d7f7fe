//! A running machine: the state of all nodes, and how messages go between them.

use std::cell::{OnceCell, RefCell};
use std::rc::{Rc, Weak};

use desim::{Alarm, Handle, Time};

use super::coprocessor::Job;
use super::envelope::{Envelope, Rank};
use super::full_buffers::FullBuffers;
use super::message_layer::MessageLayer;
use super::observer::{MachineObserver, Sent};
use super::state::{NodeState, Sender};
use super::transport::Transport;
use crate::network::{Message, Network};

/// What all nodes of a running machine share.
pub(crate) struct Shared<M> {
    pub(crate) handle: Handle,
    pub(crate) layer: MessageLayer,
    pub(crate) transport: RefCell<Transport<M>>,
    /// Goes off at the network's next event.
    network_alarm: Alarm,
    pub(crate) nodes: Vec<NodeState<M>>,
    /// The deadlock by full buffers that has halted the simulation.
    pub(crate) full_buffers: RefCell<Option<FullBuffers>>,
    pub(crate) observer: OnceCell<Rc<RefCell<dyn MachineObserver<M>>>>,
}

impl<M: 'static> Shared<M> {
    /// A machine with nothing in flight.
    pub(crate) fn new(
        handle: &Handle,
        layer: MessageLayer,
        network: Box<dyn Network>,
        nodes: Vec<NodeState<M>>,
    ) -> Rc<Shared<M>> {
        Rc::new_cyclic(|shared: &Weak<Shared<M>>| {
            let shared = shared.clone();
            let network_alarm = Alarm::new(handle, move || {
                shared.upgrade().iter().for_each(|shared| shared.advance());
            });
            Shared {
                handle: handle.clone(),
                layer,
                transport: RefCell::new(Transport::new(network)),
                network_alarm,
                nodes,
                full_buffers: RefCell::default(),
                observer: OnceCell::new(),
            }
        })
    }

    /// Puts a message on the network. Returns when the sending processor is free.
    pub(crate) fn inject(&self, envelope: Envelope<M>) -> Time {
        let mut transport = self.transport.borrow_mut();
        let places = (self.nodes[envelope.from].place, self.nodes[envelope.to].place);
        self.notify_observer(|observer| {
            let Envelope { from, to, bytes, ref message } = envelope;
            let (number, handed_over) = (transport.sent(), self.layer.handover.is_some());
            let sent = Sent { number, from, to, bytes, handed_over, message };
            observer.sent(self.handle.now(), sent);
        });
        let sender_free = transport.send(self.handle.now(), places, envelope);
        self.set_alarm(&transport);
        sender_free
    }

    /// Advances the network to the present time. Delivers what has arrived, through the coprocessors
    /// if there are any.
    fn advance(self: &Rc<Self>) {
        let mut transport = self.transport.borrow_mut();
        let mut arrived = transport.advance(self.handle.now());
        if let Some(deadlock) = &transport.deadlock {
            self.handle.halt(deadlock.to_string());
        }
        drop(transport);
        for arrival in arrived.drain(..) {
            let Message { id, bytes, .. } = arrival.message;
            let taken = self.transport.borrow_mut().take(id);
            let Some((to, message)) = taken else { continue };
            self.notify_observer(|observer| observer.arrived(arrival.at, to, id, &arrival.stalls));
            match self.layer.handover {
                Some(_) => self.assign(to, Job::Receive(bytes, message)),
                None => self.deliver(to, bytes, message),
            }
        }
        let mut transport = self.transport.borrow_mut();
        transport.recycle(arrived);
        self.set_alarm(&transport);
    }

    /// Calls the machine's observer, if there is one.
    pub(crate) fn notify_observer(&self, call: impl FnOnce(&mut dyn MachineObserver<M>)) {
        if let Some(observer) = self.observer.get() {
            call(&mut *observer.borrow_mut());
        }
    }

    fn set_alarm(&self, transport: &Transport<M>) {
        if let Some(time) = transport.network.next_event() {
            self.network_alarm.set(time);
        }
    }

    /// Puts a message into its receiver's mailbox. It stays in the buffers if no receive is posted.
    fn deliver(self: &Rc<Self>, to: Rank, bytes: u64, message: M) {
        if self.nodes[to].put_mail(message, bytes) {
            self.release(to, bytes);
        }
    }

    /// Frees room in a node's buffers.
    pub(crate) fn release(self: &Rc<Self>, rank: Rank, bytes: u64) {
        if let Some(buffers) = &self.nodes[rank].buffers {
            let served = buffers.borrow_mut().release(bytes);
            self.resume(rank, served);
        }
    }

    /// Removes the limit of a node's buffers: it reads nothing more.
    pub(crate) fn open(self: &Rc<Self>, rank: Rank) {
        if let Some(buffers) = &self.nodes[rank].buffers {
            let served = buffers.borrow_mut().open();
            self.resume(rank, served);
        }
    }

    /// Resumes senders that have found room in a node's buffers.
    fn resume(self: &Rc<Self>, rank: Rank, served: Vec<Sender<M>>) {
        for sender in served {
            match sender {
                Sender::Processor(sender) => self.nodes[sender].waits_for.set(None),
                Sender::Coprocessor(envelope) => self.assign(envelope.from, Job::Send(envelope)),
            }
            self.nodes[rank].room.notify();
        }
    }

    /// Gives a message to the sender's coprocessor as soon as the receiver has room for it.
    pub(crate) fn hand_over(self: &Rc<Self>, envelope: Envelope<M>) {
        if let Some(buffers) = &self.nodes[envelope.to].buffers {
            let mut buffers = buffers.borrow_mut();
            if !buffers.try_take(envelope.bytes) {
                self.nodes[envelope.from].ledger.borrow_mut().held();
                return buffers.queue(envelope.bytes, Sender::Coprocessor(envelope));
            }
        }
        self.assign(envelope.from, Job::Send(envelope));
    }

    /// Adds a job to a node's coprocessor.
    fn assign(self: &Rc<Self>, rank: Rank, job: Job<M>) {
        let is_idle = self.nodes[rank].coprocessor.borrow_mut().push(job);
        if is_idle {
            self.start_job(rank);
        }
    }

    /// Starts the next job of a node's coprocessor, and the one after it at its end.
    fn start_job(self: &Rc<Self>, rank: Rank) {
        let job = self.nodes[rank].coprocessor.borrow_mut().start_next();
        let begin = self.handle.now();
        let done = move |shared: &Rc<Self>| {
            let span = shared.handle.now() - begin;
            shared.nodes[rank].ledger.borrow_mut().coprocessor(span);
            shared.start_job(rank);
        };
        match job {
            None => {}
            Some(Job::Send(envelope)) => {
                self.at(begin + self.layer.packing(envelope.bytes), move |shared| {
                    let free = shared.inject(envelope);
                    shared.at(free, done);
                });
            }
            Some(Job::Receive(bytes, message)) => {
                let overhead = self.transport.borrow().network.receive_overhead();
                self.at(begin + overhead, move |shared| {
                    shared.deliver(rank, bytes, message);
                    done(shared);
                });
            }
        }
    }

    /// Schedules an action, which does nothing if the machine is gone by then.
    fn at(self: &Rc<Self>, time: Time, action: impl FnOnce(&Rc<Self>) + 'static) {
        let shared = Rc::downgrade(self);
        self.handle.at(time, move || {
            if let Some(shared) = shared.upgrade() {
                action(&shared);
            }
        });
    }
}
