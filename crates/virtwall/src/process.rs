//! What a process on a node may do. The programs know their machine only through this.

use desim::Time;
use multicomputer::{Rank, Segment};
use radiosity::Work;

use crate::footprint::Footprint;
use crate::message::Source;
use crate::observer::Observer;

/// A process on a node, simulated or real. Messages are bytes: what is not encoded does not travel.
#[expect(async_fn_in_trait, reason = "a process stays on its own thread")]
pub trait Process {
    /// Its own rank.
    fn rank(&self) -> Rank;

    /// Run a kernel here; the work that it counted is charged to this node.
    async fn compute<T>(&self, job: impl FnOnce() -> (T, Work)) -> T;

    /// Wait for what a shot, just computed, and the search after it find missing in the caches. A
    /// process whose caches are not modelled takes no notice.
    async fn fetch(&self, _source: &Source) {}

    /// The program makes something that it keeps in memory. As with the two that follow, a process
    /// whose memory is not modelled takes no notice.
    fn keep(&self, _segment: Segment, _footprint: impl FnOnce() -> Footprint) {}

    /// The program uses what it keeps; costs this node the paging of what is not in memory.
    async fn touch(&self, _segments: impl IntoIterator<Item = Segment>) {}

    /// The program needs something no more that it kept.
    fn release(&self, _segment: Segment) {}

    /// Send a message; costs this node its overhead, then travels.
    async fn send(&self, to: Rank, message: Vec<u8>);

    /// What has arrived and was not read yet.
    async fn received(&self) -> Vec<Vec<u8>>;

    /// Idle until something has arrived that was not read.
    async fn wait(&self);

    /// The same, but not beyond `time`; whether something has arrived.
    async fn wait_until(&self, time: Time) -> bool;

    /// Puts an update into the queue for the display. As with the two that follow, a process behind
    /// which no display is modelled takes no notice.
    fn queue_for_display(&self, _update: &[u8]) {}

    /// Whether there is to be more in that queue before the next one is sent.
    fn wants_updates(&self) -> bool {
        false
    }

    /// Sends the next queued update to the display; false if there is none.
    async fn socket_send(&self) -> bool {
        false
    }

    /// The time since the program began.
    fn now(&self) -> Time;

    /// Tell whoever observes this run, if somebody does.
    fn observe(&self, _tell: impl FnOnce(&mut dyn Observer)) {}
}
