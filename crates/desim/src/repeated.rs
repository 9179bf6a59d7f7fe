//! The callback of an alarm, and the time for which it is set.

use std::cell::Cell;

use crate::time::Time;

pub(crate) struct Repeated {
    pub(crate) action: Box<dyn Fn()>,
    /// When it will be called. An event for another time is stale.
    pub(crate) due: Cell<Option<Time>>,
}

impl Repeated {
    /// Whether it is due at `time`.
    pub(crate) fn is_due(&self, time: Time) -> bool {
        self.due.get() == Some(time)
    }

    /// Calls it. The callback may set the alarm again.
    pub(crate) fn call(&self) {
        self.due.set(None);
        (self.action)();
    }
}
