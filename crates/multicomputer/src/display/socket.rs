//! The service node's end of the connection to a display. Paper: Figure 6, socket_send.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use desim::{Duration, Signal, Time};

use super::display::{Display, WhenFull};
use crate::node::{Activity, Buffers, Node};

/// Counts of the updates for a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DisplayAccount {
    /// Updates that the display has shown.
    pub shown: u64,
    /// Their bytes.
    pub shown_bytes: u64,
    /// Updates that the service node has dropped.
    pub dropped: u64,
    /// When the display had shown the last one.
    pub last_shown: Time,
    /// How long the Ethernet was busy.
    pub ethernet_busy: Duration,
    /// How long the display was busy.
    pub consumer_busy: Duration,
}

/// The queue of updates at the service node, and the connection from there to the display. An update is
/// only a number of bytes here.
pub struct Socket<M> {
    node: Node<M>,
    connection: Rc<Connection>,
}

struct Connection {
    display: Display,
    state: RefCell<State>,
    /// There is room in the window for the next update.
    room: Signal,
}

struct State {
    /// Bytes of each update that was not sent.
    queue: VecDeque<u64>,
    queued_bytes: u64,
    /// Updates that were sent and not taken by the display.
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
        let connection = Connection { display: display.clone(), state: RefCell::new(state), room };
        Socket { node, connection: Rc::new(connection) }
    }

    /// Queues an update. If there is no room, the update or the oldest queued ones are dropped, as
    /// [`WhenFull`] says.
    pub fn queue(&self, bytes: u64) {
        let Connection { display, state, .. } = &*self.connection;
        let mut state = state.borrow_mut();
        let fits = |queued: u64| queued == 0 || queued + bytes <= display.service_buffers;
        match display.when_full {
            // Senders have waited for room in the message buffers, so this queue needs no limit.
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

    /// Whether the process should queue more updates before it sends the next one.
    pub fn wants_more(&self) -> bool {
        self.connection.display.when_full != WhenFull::BackPressure
            || self.connection.state.borrow().queue.is_empty()
    }

    /// Sends the oldest queued update: the processor makes its frames and waits for room in the
    /// window. Returns false if the queue is empty.
    pub async fn send(&self) -> bool {
        let Some(bytes) = self.connection.state.borrow_mut().take() else { return false };
        let forwarding = self.connection.display.forwarding(bytes);
        self.node.busy(Activity::Forward, self.node.now() + forwarding).await;
        if !self.connection.state.borrow_mut().window.try_take(bytes) {
            self.connection.state.borrow_mut().window.queue(bytes, ());
            self.node.wait_in(Activity::WaitForDisplay, &self.connection.room).await;
        }
        self.transmit(bytes);
        true
    }

    /// The Ethernet carries one update at a time, and then the display shows one at a time.
    fn transmit(&self, bytes: u64) {
        let Connection { display, state, .. } = &*self.connection;
        let mut state = state.borrow_mut();
        let wire = display.ethernet.time(bytes);
        let arrives = state.ethernet_free.max(self.node.now()) + wire;
        let shown = state.consumer_free.max(arrives) + display.update_time;
        (state.ethernet_free, state.consumer_free) = (arrives, shown);
        state.account.ethernet_busy += wire;
        let connection = Rc::downgrade(&self.connection);
        self.node.handle().at(shown, move || {
            if let Some(connection) = connection.upgrade() {
                connection.shown(bytes, shown);
            }
        });
    }

    /// The counts until now.
    pub fn account(&self) -> DisplayAccount {
        self.connection.state.borrow().account
    }
}

impl State {
    fn take(&mut self) -> Option<u64> {
        let bytes = self.queue.pop_front()?;
        self.queued_bytes -= bytes;
        Some(bytes)
    }
}

impl Connection {
    /// The display has shown an update.
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
