//! Alarms: a repeated callback whose next time can be moved forward.

use std::cell::Cell;
use std::rc::Rc;

use crate::event::Event;
use crate::handle::Handle;
use crate::repeated::Repeated;
use crate::state::State;
use crate::time::Time;

/// A callback that runs, as an event of its own, at each time for which the alarm was set. Unlike
/// [`Handle::at`] it allocates no memory each time. Clones are the same alarm.
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

    /// Sets the alarm for `time`, unless it is already set for that or an earlier time. A past
    /// time counts as the present.
    pub fn set(&self, time: Time) {
        let time = time.max(self.state.now.get());
        if self.repeated.due.get().is_none_or(|due| time < due) {
            self.repeated.due.set(Some(time));
            self.state.schedule(time, Event::Alarm(Rc::clone(&self.repeated)));
        }
    }
}
