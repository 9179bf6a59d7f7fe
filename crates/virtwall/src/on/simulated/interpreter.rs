//! Translates events of the machine into events of the algorithm.

use std::collections::VecDeque;

use desim::Time;
use multicomputer::{self as machine, MachineObserver, Rank, Sent, Stall};

use crate::observe::{Activity, SentMessage, SharedObserver};
use crate::program::Event;
use crate::wire::MessageKind;

/// A message as the simulated machine carries it.
pub(super) struct Envelope {
    pub from: Rank,
    pub kind: MessageKind,
    pub bytes: Vec<u8>,
}

/// Passes on to an observer what the machine does, with the program's purpose: the machine knows that a node
/// computes and sends, the observer learns of shots and sources.
pub(super) struct Interpreter {
    observer: SharedObserver,
    /// By rank.
    nodes: Vec<Purpose>,
}

/// What a node is doing.
struct Purpose {
    kernel: Activity,
    sends: MessageKind,
    /// Numbers of the messages that have arrived and were not read.
    unread: VecDeque<u64>,
}

impl Interpreter {
    pub fn new(observer: SharedObserver, ranks: usize) -> Interpreter {
        let purpose = || Purpose {
            kernel: Activity::Selection,
            sends: MessageKind::Source,
            unread: VecDeque::new(),
        };
        Interpreter { observer, nodes: std::iter::repeat_with(purpose).take(ranks).collect() }
    }

    /// A node begins to send a message.
    pub fn sends(&mut self, rank: Rank, kind: MessageKind) {
        self.nodes[rank].sends = kind;
    }

    /// From now on a node's program keeps these bytes.
    pub fn memory(&mut self, now: Time, rank: Rank, bytes: u64) {
        self.observer.borrow_mut().memory(now, rank, bytes);
    }

    /// Something has happened in a node's program.
    pub fn note(&mut self, now: Time, rank: Rank, event: &Event) {
        let mut observer = self.observer.borrow_mut();
        let kernel = &mut self.nodes[rank].kernel;
        match *event {
            Event::Selected(source) => {
                let local = source.is_local();
                *kernel = if local { Activity::LocalShot } else { Activity::ReceivedShot };
                observer.selected(now, rank, source);
            }
            Event::Shot { source, shot, reflected } => {
                *kernel = Activity::Selection;
                observer.shot(now, rank, source, shot, reflected);
            }
            Event::Queued { waiting, .. } | Event::Taken { waiting, .. } => {
                observer.queue(now, rank, waiting);
            }
            Event::Brightest(_) | Event::HandedOn(_) => {}
        }
    }
}

impl MachineObserver<Envelope> for Interpreter {
    fn activity(&mut self, rank: Rank, activity: machine::Activity, from: Time, to: Time) {
        let Purpose { kernel, sends, .. } = self.nodes[rank];
        let activity = match activity {
            machine::Activity::Compute => kernel,
            machine::Activity::Send => Activity::Send(sends),
            machine::Activity::Receive => Activity::Receive,
            machine::Activity::Paging => Activity::Paging,
            machine::Activity::Pack => Activity::Pack,
            machine::Activity::Copy => Activity::Copy,
            machine::Activity::WaitForRoom => Activity::WaitForRoom,
            machine::Activity::Forward => Activity::Forward,
            machine::Activity::WaitForDisplay => Activity::WaitForDisplay,
            machine::Activity::Idle => Activity::Wait,
        };
        self.observer.borrow_mut().activity(rank, activity, from, to);
    }

    fn sent(&mut self, now: Time, message: Sent<'_, Envelope>) {
        let Sent { number, from, to, bytes, handed_over, message } = message;
        let kind = message.kind;
        let message = SentMessage { number, from, to, kind, bytes, handed_over };
        self.observer.borrow_mut().sent(now, &message);
    }

    fn arrived(&mut self, now: Time, to: Rank, number: u64, stalls: &[Stall]) {
        self.nodes[to].unread.push_back(number);
        self.observer.borrow_mut().arrived(now, number, stalls);
    }

    fn read(&mut self, now: Time, rank: Rank, count: usize) {
        for number in self.nodes[rank].unread.drain(..count) {
            self.observer.borrow_mut().read(now, rank, number);
        }
    }
}
