//! Alarms: an action called again and again, at times that may be brought forward.

use std::cell::Cell;
use std::rc::Rc;

use crate::event::Event;
use crate::handle::Handle;
use crate::repeated::Repeated;
use crate::state::State;
use crate::time::Time;

/// An action that is called, as an event of its own, whenever a time comes for which it was set.
/// Unlike [`Handle::at`] it asks for no memory each time. Clones are the same alarm.
#[derive(Clone)]
pub struct Alarm {
    state: Rc<State>,
    repeated: Rc<Repeated>,
}

impl Alarm {
    /// An alarm that is not set.
    pub fn new(handle: &Handle, action: impl Fn() + 'static) -> Alarm {
        let repeated = Repeated { action: Box::new(action), due: Cell::default() };
        Alarm { state: Rc::clone(&handle.0), repeated: Rc::new(repeated) }
    }

    /// Sets the alarm for `time`, unless it is set for that or an earlier time already. A time that
    /// is past counts as the present.
    pub fn set(&self, time: Time) {
        let time = time.max(self.state.now.get());
        if self.repeated.due.get().is_none_or(|due| time < due) {
            self.repeated.due.set(Some(time));
            self.state.schedule(time, Event::Alarm(Rc::clone(&self.repeated)));
        }
    }
}
