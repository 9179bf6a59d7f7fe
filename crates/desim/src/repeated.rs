//! An action that is called again and again, at times that may be brought forward.

use std::cell::Cell;

use crate::time::Time;

pub(crate) struct Repeated {
    pub(crate) action: Box<dyn Fn()>,
    /// When it will be called; an event for another time is stale.
    pub(crate) due: Cell<Option<Time>>,
}

impl Repeated {
    /// Whether it is due at `time`.
    pub(crate) fn is_due(&self, time: Time) -> bool {
        self.due.get() == Some(time)
    }

    /// Calls it; the action may make itself due anew.
    pub(crate) fn call(&self) {
        self.due.set(None);
        (self.action)();
    }
}
