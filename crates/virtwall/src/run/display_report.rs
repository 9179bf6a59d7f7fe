//! A report on the display: updates shown and dropped, waiting times (Figure 6 of RR-3008).

use desim::{Duration, Time};
use multicomputer::{DisplayAccount, NodeAccount};

/// What became of the updates for the display, and how long nodes waited for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayReport {
    /// From the end of the computation until the display had taken the last update.
    pub lag: Duration,
    /// Updates that the display has taken.
    pub shown: u64,
    /// Updates that were sent and never shown: the service node dropped them, or they arrived after it had
    /// read of the end.
    pub dropped: u64,
    /// Time in which compute nodes waited for room at the service node, summed over nodes.
    pub waiting: Duration,
    /// Busy time of the service node's processor, as a fraction of the time until it had sent the last
    /// update on.
    pub service_busy: f64,
    /// Time in which frames were on the Ethernet, as a fraction of the time until the end, or until
    /// the last update was shown if that was later.
    pub ethernet_busy: f64,
    /// The same for the display.
    pub consumer_busy: f64,
}

impl DisplayReport {
    /// The report of a run of this time and number of updates sent; the accounts are those of the compute
    /// nodes and, last, of the service node.
    pub(crate) fn of(
        (time, sent): (Time, u64),
        accounts: &[NodeAccount],
        display: &DisplayAccount,
    ) -> DisplayReport {
        let (service, nodes) = accounts.split_last().expect("a machine has a service node");
        let life = service.life();
        let busy = life - service.idle - service.waiting_for_display;
        let all = time.max(display.last_shown) - Time::ZERO;
        DisplayReport {
            lag: time.max(display.last_shown) - time,
            shown: display.shown,
            dropped: sent - display.shown,
            waiting: nodes.iter().map(|node| node.waiting_for_display).sum(),
            service_busy: fraction(busy, life),
            ethernet_busy: fraction(display.ethernet_busy, all),
            consumer_busy: fraction(display.consumer_busy, all),
        }
    }
}

fn fraction(part: Duration, whole: Duration) -> f64 {
    if whole > Duration::ZERO { part.as_seconds_f64() / whole.as_seconds_f64() } else { 0.0 }
}
