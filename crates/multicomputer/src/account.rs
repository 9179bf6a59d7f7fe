//! Where a node's time went.

use desim::{Duration, Time};

/// What a node did with its time, and its traffic. The five spans sum exactly to the node's life:
/// from the start until it finished, or until the account was drawn up.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NodeAccount {
    /// Time in kernels.
    pub compute: Duration,
    /// Time given to sending messages.
    pub send_overhead: Duration,
    /// Time given to taking messages in.
    pub receive_overhead: Duration,
    /// Time spent waiting for pages that were not in memory.
    pub paging: Duration,
    /// The rest.
    pub idle: Duration,
    /// Messages sent.
    pub messages_sent: u64,
    /// Bytes in them.
    pub bytes_sent: u64,
    /// Messages taken out of the mailbox.
    pub messages_received: u64,
    /// The most bytes that program and message buffers have held, where memory is modelled.
    pub memory_high_water: Option<u64>,
    /// When the node finished, if it said so.
    pub finished: Option<Time>,
}

impl NodeAccount {
    /// The node's life: all five spans.
    pub fn life(&self) -> Duration {
        self.compute + self.send_overhead + self.receive_overhead + self.paging + self.idle
    }
}

/// What a node is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Activity {
    Compute,
    Send,
    Receive,
    Paging,
    #[default]
    Idle,
}

/// An account that is being kept: at any moment the node does one thing, and when it turns to
/// another the time since the last turn is entered. So nothing is lost and nothing counted twice.
#[derive(Default)]
pub(crate) struct Ledger {
    account: NodeAccount,
    activity: Activity,
    since: Time,
}

impl Ledger {
    /// The node turns to another activity.
    pub(crate) fn turn_to(&mut self, activity: Activity, now: Time) {
        self.enter(now);
        self.activity = activity;
    }

    /// A message leaves.
    pub(crate) fn sent(&mut self, bytes: u64) {
        self.account.messages_sent += 1;
        self.account.bytes_sent = self.account.bytes_sent.saturating_add(bytes);
    }

    /// Messages are taken in.
    pub(crate) fn received(&mut self, messages: u64) {
        self.account.messages_received += messages;
    }

    /// The node's life ends. Only the first end counts.
    pub(crate) fn finish(&mut self, now: Time) {
        self.enter(now);
        self.account.finished.get_or_insert(now);
    }

    /// The account until `now`.
    pub(crate) fn account(&mut self, now: Time) -> NodeAccount {
        self.enter(now);
        self.account.clone()
    }

    fn enter(&mut self, now: Time) {
        if self.account.finished.is_none() {
            let spent = now - self.since;
            *match self.activity {
                Activity::Compute => &mut self.account.compute,
                Activity::Send => &mut self.account.send_overhead,
                Activity::Receive => &mut self.account.receive_overhead,
                Activity::Paging => &mut self.account.paging,
                Activity::Idle => &mut self.account.idle,
            } += spent;
        }
        self.since = now;
    }
}
