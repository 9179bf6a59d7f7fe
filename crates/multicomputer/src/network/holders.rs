//! The messages that held a channel, remembered while another message waits for it.

use std::collections::VecDeque;

use desim::Time;

use super::channel::Channel;
use super::network::Stall;

/// The past holders of a channel and when each left, the earliest first.
#[derive(Default)]
pub(crate) struct PastHolders(VecDeque<(u64, Time)>);

impl PastHolders {
    /// A message has left the channel, or will at `until`.
    pub(crate) fn left(&mut self, message: u64, until: Time) {
        self.0.push_back((message, until));
    }

    /// Forgets those that left at `now` or earlier.
    pub(crate) fn forget(&mut self, now: Time) {
        while self.0.front().is_some_and(|&(_, until)| until <= now) {
            self.0.pop_front();
        }
    }

    /// The waits of a message that has waited since `since` and gets the channel now.
    pub(crate) fn stalls(&self, channel: Channel, since: Time) -> impl Iterator<Item = Stall> {
        let mut from = since;
        self.0.iter().filter(move |&&(_, until)| until > since).map(move |&(by, until)| {
            let span = until - from;
            from = until;
            Stall { channel, by, span }
        })
    }
}
