//! Deadlock in the network: messages that wait for each other in a cycle.

use thiserror::Error;

use super::channel::Channel;
use super::message::Message;
use super::topology::Topology;

/// A circle of messages, each of which waits for a channel that the next one holds. None of them
/// will ever move.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}", self.describe(|_| "a message".to_owned()))]
pub struct Deadlock {
    /// The circle; the last one waits for the first.
    pub circle: Vec<Waiting>,
}

/// A message of a deadlock.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Waiting {
    /// The message.
    pub message: Message,
    /// The channel that it waits for, which the next message of the circle holds.
    pub channel: Channel,
    /// That channel in words.
    pub channel_name: String,
}

impl Deadlock {
    /// Follows `next`, from a message to the channel that it waits for and the message that holds it,
    /// until the circle is closed. Every message that `next` leads to must wait.
    pub(crate) fn find(
        start: u32,
        topology: &Topology,
        next: impl Fn(u32) -> Option<(Message, Channel, u32)>,
    ) -> Deadlock {
        let mut way: Vec<(u32, Waiting)> = Vec::new();
        let mut here = start;
        while way.iter().all(|(seen, _)| *seen != here) {
            let Some((message, channel, holder)) = next(here) else { break };
            let channel_name = channel.describe(topology);
            way.push((here, Waiting { message, channel, channel_name }));
            here = holder;
        }
        let circle = way.into_iter().skip_while(|(seen, _)| *seen != here).map(|(_, w)| w);
        Deadlock { circle: circle.collect() }
    }

    /// The circle in words, with the caller's name for a message.
    pub fn describe(&self, name: impl Fn(&Message) -> String) -> String {
        let waits = self.circle.iter().map(|Waiting { message, channel_name, .. }| {
            let (from, to) = (message.from.index(), message.to.index());
            format!("{} ({from} to {to}) waits for {channel_name}", name(message))
        });
        let waits = waits.collect::<Vec<_>>().join(", held by ");
        format!("deadlock in the network: {waits}, held by the first one")
    }
}
