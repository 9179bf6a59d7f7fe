//! Sends updates of runs that are under way to live viewers.

use std::sync::Arc;

use viewer::Subscriber;

use crate::host::host_clock::Interval;

/// Receives updates of a run, with the run's index in [`crate::Plan::runs`]. The simulating thread calls it, so
/// it must return at once.
pub type Feed = Arc<dyn Fn(usize, News) + Send + Sync>;

/// An update of a run.
pub enum News {
    /// What has happened since the part before, in the format of the viewer's page.
    Part(String),
    /// The run has ended.
    End,
}

/// Host seconds between parts.
const BETWEEN_PARTS: f64 = 0.2;

/// Passes the updates of one run to a feed.
pub struct Follower {
    run: usize,
    feed: Feed,
    interval: Interval,
}

impl Follower {
    pub fn new(run: usize, feed: Feed) -> Follower {
        Follower { run, feed, interval: Interval::new(BETWEEN_PARTS) }
    }
}

impl Subscriber for Follower {
    fn is_due(&mut self) -> bool {
        self.interval.is_due()
    }

    fn receive(&mut self, part: String) {
        (self.feed)(self.run, News::Part(part));
    }
}
