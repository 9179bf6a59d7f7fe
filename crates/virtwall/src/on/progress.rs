//! Notices a run that makes no progress.

use std::sync::{Mutex, PoisonError};

use radiosity::Rgb;

use crate::program::ProgramError;

/// Compares the light that one number of shots carried with that of the same number of shots before.
///
/// Every shot leaves less light to be shot, so that the light of many shots falls. It does not where
/// over-shooting diverges, or where light is so dim that rounding keeps it as it is.
pub(super) struct Progress {
    /// Shots that are compared.
    limit: u64,
    state: Mutex<State>,
}

struct State {
    shots: u64,
    /// Absolute power that they carried, W.
    carried: f64,
    /// The same of the shots before.
    before: f64,
    stuck: bool,
}

impl Progress {
    pub fn new(limit: u64) -> Progress {
        let state = State { shots: 0, carried: 0.0, before: f64::INFINITY, stuck: false };
        Progress { limit, state: Mutex::new(state) }
    }

    /// Enter a shot of a source with this power, W.
    pub fn shot(&self, power: Rgb) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.shots += 1;
        state.carried += power.abs().element_sum();
        if state.shots == self.limit {
            state.stuck |= state.carried >= state.before;
            *state = State { shots: 0, carried: 0.0, before: state.carried, stuck: state.stuck };
        }
    }

    /// # Errors
    /// If there was no progress.
    pub fn check(&self) -> Result<(), ProgramError> {
        match self.state.lock().unwrap_or_else(PoisonError::into_inner).stuck {
            true => Err(ProgramError::NoProgress { shots: self.limit }),
            false => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_that_does_not_fall_is_noticed() {
        let falls = Progress::new(10);
        (0..1_000).for_each(|shot| falls.shot(Rgb::splat(0.999_f64.powi(shot))));
        assert_eq!(falls.check(), Ok(()));
        for power in [0.0, f64::MIN_POSITIVE, -1.0] {
            let stays = Progress::new(10);
            (0..19).for_each(|_| stays.shot(Rgb::splat(power)));
            assert_eq!(stays.check(), Ok(()));
            stays.shot(Rgb::splat(power));
            assert_eq!(stays.check(), Err(ProgramError::NoProgress { shots: 10 }));
        }
    }
}
