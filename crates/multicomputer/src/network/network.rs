//! What a network is: messages go in, time passes, messages arrive.

use desim::{Duration, Time};

use super::channel::Channel;
use super::deadlock::Deadlock;
use super::message::Message;

/// How messages travel. A network is driven from outside, in the order of virtual time: whoever
/// holds it sends messages and lets time pass.
pub trait Network {
    /// Takes a message whose send begins `now`. Returns when the sending processor may go on; until
    /// then it is busy with the message. Messages between the same two places arrive in the order
    /// in which they are sent.
    fn send(&mut self, now: Time, message: Message) -> Time;

    /// What taking one message costs the processor that receives it.
    fn receive_overhead(&self) -> Duration;

    /// When something next happens in here by itself; `None` when nothing is under way.
    fn next_event(&self) -> Option<Time>;

    /// Lets time pass until `now`, at most to [`Network::next_event`], and adds the messages that
    /// arrive to `arrived`.
    ///
    /// # Errors
    /// When messages wait for each other and none of them will ever arrive.
    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock>;

    /// What each channel has done until now; nothing for a network without channels.
    fn channel_use(&self) -> Vec<ChannelUse> {
        Vec::new()
    }
}

/// A message that stands in the receiver's mailbox.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrival {
    /// The message.
    pub message: Message,
    /// Since when.
    pub at: Time,
    /// How other messages held it up on its way.
    pub stalls: Vec<Stall>,
}

/// A wait of one message for another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stall {
    /// What it waited for.
    pub channel: Channel,
    /// The message that held that meanwhile.
    pub by: u64,
    /// For how long.
    pub span: Duration,
}

/// What a channel has done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChannelUse {
    /// Which one.
    pub channel: Channel,
    /// Messages that came by.
    pub messages: u64,
    /// Time in which it carried bytes.
    pub carrying: Duration,
    /// Time in which a message held it, whether its bytes moved or not.
    pub held: Duration,
}
