//! The interface of an observer of a simulated run.

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Time};
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};

use crate::problem::Source;
use crate::wire::MessageKind;

/// Called with each event of a simulated run, in the order of virtual time. The service node's rank follows
/// those of the compute nodes.
///
/// An observer changes nothing: a run without one is the same to the bit. It implements the methods that it
/// needs.
pub trait Observer {
    /// A node has been busy with one activity for a span. Its spans follow each other without gap or overlap
    /// from the start until it knows of the end; empty spans are left out.
    fn activity(&mut self, _rank: Rank, _activity: Activity, _from: Time, _to: Time) {}

    /// A message goes onto the network.
    fn sent(&mut self, _now: Time, _message: &SentMessage) {}

    /// The message of this number has reached its receiver's node; `stalls` delayed it.
    fn arrived(&mut self, _now: Time, _number: u64, _stalls: &[Stall]) {}

    /// A node begins to read the message of this number.
    fn read(&mut self, _now: Time, _rank: Rank, _number: u64) {}

    /// A node has selected its next source (§4.2.2).
    fn selected(&mut self, _now: Time, _rank: Rank, _source: &Source) {}

    /// A node has shot a source, and its patches reflect this power of it, W.
    fn shot(&mut self, _now: Time, _rank: Rank, _source: &Source, _shot: &Shot, _reflected: Rgb) {}

    /// From now on `length` sources wait in a node's queue.
    fn queue(&mut self, _now: Time, _rank: Rank, _length: usize) {}

    /// From now on a node's program keeps `bytes`. Called where memory is modelled.
    fn memory(&mut self, _now: Time, _rank: Rank, _bytes: u64) {}
}

/// An observer that is read after the run.
pub type SharedObserver = Rc<RefCell<dyn Observer>>;

/// A message as it goes onto the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SentMessage {
    /// The number of messages sent before it.
    pub number: u64,
    /// The sender.
    pub from: Rank,
    /// The receiver.
    pub to: Rank,
    /// Its kind.
    pub kind: MessageKind,
    /// Its length.
    pub bytes: u64,
    /// Whether a coprocessor sends it: then the processor handed it over before, and goes on meanwhile.
    pub handed_over: bool,
}

/// What a node is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Activity {
    /// It searches for the best source (§4.2.2).
    Selection,
    /// It shoots a patch of its own.
    LocalShot,
    /// It shoots a source handed on to it.
    ReceivedShot,
    /// It sends a message of this kind.
    Send(MessageKind),
    /// It receives messages.
    Receive,
    /// It makes packets.
    Pack,
    /// It copies messages that arrived with no receive posted.
    Copy,
    /// It waits for room in a receiver's buffers.
    WaitForRoom,
    /// It waits for pages that were not in memory.
    Paging,
    /// It sends updates on to the display.
    Forward,
    /// It waits for room on the way to the display.
    WaitForDisplay,
    /// It waits for something to arrive.
    Wait,
}

impl Activity {
    /// Its name in reports and traces; that of a send is the message's.
    pub fn name(self) -> &'static str {
        match self {
            Activity::Selection => "selection",
            Activity::LocalShot => "local shot",
            Activity::ReceivedShot => "received shot",
            Activity::Send(kind) => kind.name(),
            Activity::Receive => "receive",
            Activity::Pack => "pack",
            Activity::Copy => "copy",
            Activity::WaitForRoom => "wait for room",
            Activity::Paging => "paging",
            Activity::Forward => "forward",
            Activity::WaitForDisplay => "wait for display",
            Activity::Wait => "wait",
        }
    }

    /// Whether the node runs a kernel.
    pub fn computes(self) -> bool {
        matches!(self, Activity::Selection | Activity::LocalShot | Activity::ReceivedShot)
    }

    /// Whether the node is busy with a message or waits for room for one.
    pub fn is_overhead(self) -> bool {
        !self.computes() && !matches!(self, Activity::Paging | Activity::Wait)
    }
}

/// The total length of stalls.
pub(super) fn blocked(stalls: &[Stall]) -> Duration {
    stalls.iter().map(|stall| stall.span).sum()
}
