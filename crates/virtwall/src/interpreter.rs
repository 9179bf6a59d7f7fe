//! Says of what a machine does what it is for.

use std::collections::VecDeque;

use desim::Time;
use multicomputer::{self as machine, MachineObserver, Rank, Sent, Stall};
use radiosity::{Rgb, Shot};

use crate::message::Source;
use crate::message_kind::MessageKind;
use crate::observer::{Activity, Observer, SentMessage, SharedObserver};

/// Stands between a machine, whose nodes compute and send, and an observer, who is told of shots and
/// sources.
pub(crate) struct Interpreter {
    observer: SharedObserver,
    /// By rank.
    nodes: Vec<Purpose>,
}

/// What a node is up to.
struct Purpose {
    kernel: Activity,
    sends: MessageKind,
    /// Numbers of the messages that have arrived and were not read.
    unread: VecDeque<u64>,
}

impl Interpreter {
    pub(crate) fn new(observer: SharedObserver, ranks: usize) -> Interpreter {
        let purpose = || Purpose {
            kernel: Activity::Selection,
            sends: MessageKind::Source,
            unread: VecDeque::new(),
        };
        Interpreter { observer, nodes: std::iter::repeat_with(purpose).take(ranks).collect() }
    }

    /// A node turns to sending a message.
    pub(crate) fn sends(&mut self, rank: Rank, message: &[u8]) {
        if let Some(kind) = MessageKind::of(message) {
            self.nodes[rank].sends = kind;
        }
    }
}

impl MachineObserver<Vec<u8>> for Interpreter {
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

    fn sent(&mut self, now: Time, message: Sent<'_, Vec<u8>>) {
        // Processes send each other nothing but encoded messages.
        let Some(kind) = MessageKind::of(message.message) else { return };
        let Sent { number, from, to, bytes, handed_over, .. } = message;
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

/// What the program tells goes on to the observer.
impl Observer for Interpreter {
    fn selected(&mut self, now: Time, rank: Rank, source: &Source) {
        let local = source.is_local();
        self.nodes[rank].kernel = if local { Activity::LocalShot } else { Activity::ReceivedShot };
        self.observer.borrow_mut().selected(now, rank, source);
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.nodes[rank].kernel = Activity::Selection;
        self.observer.borrow_mut().shot(now, rank, source, shot, reflected);
    }

    fn queue(&mut self, now: Time, rank: Rank, length: usize) {
        self.observer.borrow_mut().queue(now, rank, length);
    }

    fn memory(&mut self, now: Time, rank: Rank, bytes: u64) {
        self.observer.borrow_mut().memory(now, rank, bytes);
    }
}
