//! The trait of all network models: messages are sent, time advances, messages arrive.

use desim::{Duration, Time};

use super::channel::Channel;
use super::deadlock::Deadlock;
use super::message::Message;

/// A network model. Its user drives it in the order of virtual time: it sends messages and advances the
/// time.
pub trait Network {
    /// Sends a message, beginning `now`. Returns when the sending processor is free. Messages between
    /// the same two places arrive in the order in which they are sent.
    fn send(&mut self, now: Time, message: Message) -> Time;

    /// Time that the receiving processor spends on a message.
    fn receive_overhead(&self) -> Duration;

    /// Time of the network's next event; `None` when nothing is in flight.
    fn next_event(&self) -> Option<Time>;

    /// Advances the time to `now`, at most to [`Network::next_event`], and adds the messages that
    /// arrive to `arrived`.
    ///
    /// # Errors
    /// If messages wait for each other and none of them can ever arrive.
    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock>;

    /// The use of each channel until now; empty for a model without channels.
    fn channel_use(&self) -> Vec<ChannelUse> {
        Vec::new()
    }
}

/// A message that has arrived in the receiver's mailbox.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arrival {
    /// The message.
    pub message: Message,
    /// Time of arrival.
    pub at: Time,
    /// Its waits for other messages on the way.
    pub stalls: Vec<Stall>,
}

/// A wait of one message for another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stall {
    /// The channel that it waited for.
    pub channel: Channel,
    /// Id of the message that held the channel meanwhile.
    pub by: u64,
    /// Length of the wait.
    pub span: Duration,
}

/// The use of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChannelUse {
    /// The channel.
    pub channel: Channel,
    /// Messages that passed.
    pub messages: u64,
    /// Time in which it carried bytes.
    pub carrying: Duration,
    /// Time in which a message held it, whether its bytes moved or not.
    pub held: Duration,
}
