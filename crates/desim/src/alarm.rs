//! Alarms: an action called again and again, at times that may be brought forward.

use std::cell::Cell;
use std::rc::Rc;

use crate::event::Event;
use crate::handle::Handle;
use crate::state::State;
use crate::time::Time;

/// An action that is called, as an event of its own, whenever a time comes for which it was set.
/// Unlike [`Handle::at`] it asks for no memory each time. Clones are the same alarm.
#[derive(Clone)]
pub struct Alarm {
    state: Rc<State>,
    alarm: Rc<AlarmState>,
}

pub(crate) struct AlarmState {
    action: Box<dyn Fn()>,
    /// When it will go off; an event for another time is stale.
    due: Cell<Option<Time>>,
}

impl Alarm {
    /// An alarm that is not set.
    pub fn new(handle: &Handle, action: impl Fn() + 'static) -> Alarm {
        let alarm = AlarmState { action: Box::new(action), due: Cell::default() };
        Alarm { state: Rc::clone(&handle.0), alarm: Rc::new(alarm) }
    }

    /// Sets the alarm for `time`, unless it is set for that or an earlier time already. A time that
    /// is past counts as the present.
    pub fn set(&self, time: Time) {
        let time = time.max(self.state.now.get());
        if self.alarm.due.get().is_none_or(|due| time < due) {
            self.alarm.due.set(Some(time));
            self.state.schedule(time, Event::Alarm(Rc::clone(&self.alarm)));
        }
    }
}

impl AlarmState {
    /// Whether the alarm is set for `time`.
    pub(crate) fn is_due(&self, time: Time) -> bool {
        self.due.get() == Some(time)
    }

    /// Goes off; the action may set the alarm anew.
    pub(crate) fn go_off(&self) {
        self.due.set(None);
        (self.action)();
    }
}
