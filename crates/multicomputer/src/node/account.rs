//! A node's account: its time, by activity.

use desim::{Duration, Time};

/// A node's time by activity, and its messages. The times of all activities add up exactly to the node's
/// life: from the start until it finished, or until the account was requested.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NodeAccount {
    /// Time in kernels.
    pub compute: Duration,
    /// Send overhead.
    pub send_overhead: Duration,
    /// Receive overhead.
    pub receive_overhead: Duration,
    /// The rest of the message layer.
    pub layer: LayerAccount,
    /// Time spent waiting for pages that were not resident.
    pub paging: Duration,
    /// Time spent sending updates to the display, on the service node.
    pub forwarding: Duration,
    /// Time spent waiting for room on the connection to the display.
    pub waiting_for_display: Duration,
    /// The remaining time.
    pub idle: Duration,
    /// Messages sent.
    pub messages_sent: u64,
    /// Bytes in them.
    pub bytes_sent: u64,
    /// Messages read.
    pub messages_received: u64,
    /// The most bytes in use at a time by program and message buffers; none where memory is not
    /// modelled.
    pub memory_high_water: Option<u64>,
    /// When the node finished; none if it has not.
    pub finished: Option<Time>,
}

/// What the message layer did on a node, besides the overheads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LayerAccount {
    /// Time spent making packets.
    pub packing: Duration,
    /// Time spent copying messages that arrived with no receive posted.
    pub copying: Duration,
    /// Time spent waiting for room in receivers' buffers.
    pub waiting_for_room: Duration,
    /// Time in which the message coprocessor was busy; not a part of the node's life.
    pub coprocessor: Duration,
    /// Messages received that had arrived with no receive posted.
    pub unposted_messages: u64,
    /// Messages sent that had to wait for room in buffers.
    pub held_messages: u64,
    /// The most bytes in use at a time in the node's buffers; 0 if they are unlimited.
    pub buffer_bytes_most: u64,
}

impl NodeAccount {
    /// Time that the processor spent on messages.
    pub fn overhead(&self) -> Duration {
        let LayerAccount { packing, copying, waiting_for_room, .. } = self.layer;
        self.send_overhead
            + self.receive_overhead
            + packing
            + copying
            + waiting_for_room
            + self.forwarding
            + self.waiting_for_display
    }

    /// The node's life: the time of all activities.
    pub fn life(&self) -> Duration {
        self.compute + self.overhead() + self.paging + self.idle
    }
}

impl LayerAccount {
    /// Adds another node's account; of the bytes in buffers, keeps the larger number.
    pub fn add(&mut self, other: &LayerAccount) {
        self.packing += other.packing;
        self.copying += other.copying;
        self.waiting_for_room += other.waiting_for_room;
        self.coprocessor += other.coprocessor;
        self.unposted_messages += other.unposted_messages;
        self.held_messages += other.held_messages;
        self.buffer_bytes_most = self.buffer_bytes_most.max(other.buffer_bytes_most);
    }
}

/// The activity of a node's processor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Activity {
    /// It runs a kernel.
    Compute,
    /// It sends a message.
    Send,
    /// It reads messages.
    Receive,
    /// It waits for pages that were not resident.
    Paging,
    /// It makes packets.
    Pack,
    /// It copies messages that arrived with no receive posted.
    Copy,
    /// It waits for room in a receiver's buffers.
    WaitForRoom,
    /// It sends an update to the display.
    Forward,
    /// It waits for room on the connection to the display.
    WaitForDisplay,
    /// It waits for messages.
    #[default]
    Idle,
}

/// Called for each span, as (activity, from, to).
type SpanObserver = Box<dyn FnMut(Activity, Time, Time)>;

/// Keeps a node's account. At each change of activity the time since the last change is entered, so no
/// time is lost or counted twice.
#[derive(Default)]
pub(crate) struct Ledger {
    account: NodeAccount,
    activity: Activity,
    since: Time,
    observer: Option<SpanObserver>,
}

impl Ledger {
    /// Calls `observer` for every span from now on, as (activity, from, to).
    pub(crate) fn observe(&mut self, observer: impl FnMut(Activity, Time, Time) + 'static) {
        self.observer = Some(Box::new(observer));
    }

    /// The node changes to another activity.
    pub(crate) fn turn_to(&mut self, activity: Activity, now: Time) {
        self.enter(now);
        self.activity = activity;
    }

    /// A message is sent.
    pub(crate) fn sent(&mut self, bytes: u64) {
        self.account.messages_sent += 1;
        self.account.bytes_sent = self.account.bytes_sent.saturating_add(bytes);
    }

    /// Messages are read, some of which arrived with no receive posted.
    pub(crate) fn received(&mut self, messages: u64, unposted: u64) {
        self.account.messages_received += messages;
        self.account.layer.unposted_messages += unposted;
    }

    /// A message has to wait for room.
    pub(crate) fn held(&mut self) {
        self.account.layer.held_messages += 1;
    }

    /// The coprocessor was busy for a span.
    pub(crate) fn coprocessor(&mut self, span: Duration) {
        self.account.layer.coprocessor += span;
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
                Activity::Pack => &mut self.account.layer.packing,
                Activity::Copy => &mut self.account.layer.copying,
                Activity::WaitForRoom => &mut self.account.layer.waiting_for_room,
                Activity::Forward => &mut self.account.forwarding,
                Activity::WaitForDisplay => &mut self.account.waiting_for_display,
                Activity::Idle => &mut self.account.idle,
            } += spent;
            if let Some(observer) = self.observer.as_mut().filter(|_| spent > Duration::ZERO) {
                observer(self.activity, self.since, now);
            }
        }
        self.since = now;
    }
}
