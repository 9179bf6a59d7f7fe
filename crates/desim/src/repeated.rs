//! The callback of an alarm, and the time for which it is set.

use std::cell::Cell;

use crate::time::Time;

/// A callback that can be scheduled again and again.
pub(crate) struct Repeated {
    pub(crate) action: Box<dyn Fn()>,
    /// Time of its next call. An event for any other time is obsolete.
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
