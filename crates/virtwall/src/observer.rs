//! Who is told what happens in a simulated run, as it happens.

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Time};
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};

use crate::message::Source;
use crate::message_kind::MessageKind;

/// Told what happens in a simulated run, in the order of virtual time. The rank that follows those of
/// the compute nodes is the service node's.
///
/// It changes nothing: a run that nobody observes is the same to the bit. Whatever an observer does
/// not care for, it leaves out.
pub trait Observer {
    /// A node has done one thing for a while. Its spans follow each other without gap or overlap,
    /// from the start until it knows of the end; those of no length are not told.
    fn activity(&mut self, _rank: Rank, _activity: Activity, _from: Time, _to: Time) {}

    /// A message goes onto the network.
    fn sent(&mut self, _now: Time, _message: &SentMessage) {}

    /// The message of this number has come to its receiver; by its way others held it up.
    fn arrived(&mut self, _now: Time, _number: u64, _stalls: &[Stall]) {}

    /// A node begins to take in the message of this number.
    fn read(&mut self, _now: Time, _rank: Rank, _number: u64) {}

    /// A node has chosen what it will shoot next (§4.2.2).
    fn selected(&mut self, _now: Time, _rank: Rank, _source: &Source) {}

    /// A node has shot a source, and its patches reflect so much of it, W.
    fn shot(&mut self, _now: Time, _rank: Rank, _source: &Source, _shot: &Shot, _reflected: Rgb) {}

    /// So many sources wait in a node's queue from now on.
    fn queue(&mut self, _now: Time, _rank: Rank, _length: usize) {}

    /// The program of a node keeps so many bytes from now on. Told where memory is modelled.
    fn memory(&mut self, _now: Time, _rank: Rank, _bytes: u64) {}
}

/// An observer that a run tells, and that is looked at when the run is over.
pub type SharedObserver = Rc<RefCell<dyn Observer>>;

/// A message as it goes onto the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SentMessage {
    /// How many went before it.
    pub number: u64,
    /// Who sends it.
    pub from: Rank,
    /// Who is to get it.
    pub to: Rank,
    /// What it is about.
    pub kind: MessageKind,
    /// Its length.
    pub bytes: u64,
    /// Whether a coprocessor sends it: then the processor has sent it before, and goes on meanwhile.
    pub handed_over: bool,
}

/// What a node is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Activity {
    /// It looks for the best source (§4.2.2).
    Selection,
    /// It shoots a patch of its own.
    LocalShot,
    /// It shoots a source handed on to it.
    ReceivedShot,
    /// It gives away a message of this kind.
    Send(MessageKind),
    /// It takes messages in.
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
    /// Its name, for people; a send's is the message's.
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

    /// Whether the node is busy with a message, or waits for room for one.
    pub fn is_overhead(self) -> bool {
        !self.computes() && !matches!(self, Activity::Paging | Activity::Wait)
    }
}

/// How long messages were held up in all.
pub(crate) fn blocked(stalls: &[Stall]) -> Duration {
    stalls.iter().map(|stall| stall.span).sum()
}
