//! The service node's end of the way to a display, as the process there sees it.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use desim::{Duration, Signal, Time};

use super::display::{Display, WhenFull};
use crate::node::Activity;
use crate::node::Buffers;
use crate::node::Node;

/// What became of the updates for a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DisplayAccount {
    /// Updates that the display has taken.
    pub shown: u64,
    /// Their bytes.
    pub shown_bytes: u64,
    /// Updates that the service node has dropped.
    pub dropped: u64,
    /// When the display had taken the last one.
    pub last_shown: Time,
    /// For how long frames kept the Ethernet busy.
    pub ethernet_busy: Duration,
    /// For how long the display was busy with updates.
    pub consumer_busy: Duration,
}

/// A queue of updates at the service node, and the connection that leads from there to the display.
/// Their contents matter to nobody here: an update is a number of bytes.
pub struct Socket<M> {
    node: Node<M>,
    line: Rc<Line>,
}

struct Line {
    display: Display,
    state: RefCell<State>,
    /// The display has taken enough for the next update to be sent.
    room: Signal,
}

struct State {
    /// Updates that were not sent on, by bytes.
    queue: VecDeque<u64>,
    queued_bytes: u64,
    /// Sent and not taken by the display.
    window: Buffers<()>,
    ethernet_free: Time,
    consumer_free: Time,
    account: DisplayAccount,
}

impl<M: 'static> Socket<M> {
    /// A connection from this node to a display.
    pub fn new(display: &Display, node: Node<M>) -> Socket<M> {
        let state = State {
            queue: VecDeque::new(),
            queued_bytes: 0,
            window: Buffers::new(display.window),
            ethernet_free: Time::ZERO,
            consumer_free: Time::ZERO,
            account: DisplayAccount::default(),
        };
        let room = Signal::new(node.handle(), "room on the way to the display");
        let line = Line { display: display.clone(), state: RefCell::new(state), room };
        Socket { node, line: Rc::new(line) }
    }

    /// Puts an update into the queue; that, or one that waits there, is dropped if there is no room
    /// and that is what happens then.
    pub fn queue(&self, bytes: u64) {
        let Line { display, state, .. } = &*self.line;
        let mut state = state.borrow_mut();
        let fits = |queued: u64| queued == 0 || queued + bytes <= display.service_buffers;
        match display.when_full {
            // Senders have waited for room, and what they sent was read: it is the program's.
            WhenFull::BackPressure => {}
            WhenFull::DropNewest if !fits(state.queued_bytes) => {
                state.account.dropped += 1;
                return;
            }
            WhenFull::DropNewest => {}
            WhenFull::DropOldest => {
                while !fits(state.queued_bytes) && state.take().is_some() {
                    state.account.dropped += 1;
                }
            }
        }
        state.queue.push_back(bytes);
        state.queued_bytes += bytes;
    }

    /// Whether the process should put more into the queue before it sends on what is there.
    pub fn wants_more(&self) -> bool {
        self.line.display.when_full != WhenFull::BackPressure
            || self.line.state.borrow().queue.is_empty()
    }

    /// Sends the update on that has waited longest. The processor makes frames of it and waits until
    /// the connection takes them. False if there is none.
    pub async fn send(&self) -> bool {
        let Some(bytes) = self.line.state.borrow_mut().take() else { return false };
        let forwarding = self.line.display.forwarding(bytes);
        self.node.busy(Activity::Forward, self.node.now() + forwarding).await;
        if !self.line.state.borrow_mut().window.try_take(bytes) {
            self.line.state.borrow_mut().window.queue(bytes, ());
            self.node.wait_in(Activity::WaitForDisplay, &self.line.room).await;
        }
        self.transmit(bytes);
        true
    }

    /// One update at a time crosses the Ethernet, and then the display takes one at a time.
    fn transmit(&self, bytes: u64) {
        let Line { display, state, .. } = &*self.line;
        let mut state = state.borrow_mut();
        let wire = display.ethernet.time(bytes);
        let arrives = state.ethernet_free.max(self.node.now()) + wire;
        let shown = state.consumer_free.max(arrives) + display.update_time;
        (state.ethernet_free, state.consumer_free) = (arrives, shown);
        state.account.ethernet_busy += wire;
        let line = Rc::downgrade(&self.line);
        self.node.handle().at(shown, move || {
            if let Some(line) = line.upgrade() {
                line.shown(bytes, shown);
            }
        });
    }

    /// What became of the updates until now.
    pub fn account(&self) -> DisplayAccount {
        self.line.state.borrow().account
    }
}

impl State {
    fn take(&mut self) -> Option<u64> {
        let bytes = self.queue.pop_front()?;
        self.queued_bytes -= bytes;
        Some(bytes)
    }
}

impl Line {
    /// The display has taken an update.
    fn shown(&self, bytes: u64, now: Time) {
        let State { account, window, .. } = &mut *self.state.borrow_mut();
        account.shown += 1;
        account.shown_bytes += bytes;
        account.last_shown = now;
        account.consumer_busy += self.display.update_time;
        if !window.release(bytes).is_empty() {
            self.room.notify();
        }
    }
}
