//! Notices a run that makes no progress.

use std::sync::{Mutex, PoisonError};

use radiosity::Rgb;

use crate::problem::Source;
use crate::program::{NoProgress, ProgramError};
use crate::run::{Run, shots_to_fall};

/// How many times as many shots as make light fall to 1/e are a window, for each processor. Assumed: light
/// falls to 1/20,000 then, and [`most_carried`] is far from that.
const FALLS: f64 = 10.0;

/// The power that the shots of a window may carry, as a part of that of the window before: a tenth. Over-shooting
/// by w slows the fall of light: a step of w times the exact one takes w (2 - w) as much of the error away.
/// Source: the theory of over-relaxation.
fn most_carried(overshoot: f64) -> f64 {
    0.1_f64.powf((overshoot * (2.0 - overshoot)).clamp(0.0, 1.0))
}

/// Compares the power that a window of shots carried with that of the window before.
///
/// Shots of patches are counted, not those of sources handed on, which are part of them. On one processor
/// [`shots_to_fall`] make light fall to 1/e, and the power of as many shots falls with it.
///
/// On several processors a lightly loaded one shoots whatever arrives, however little, while light waits in the
/// queue of another: §4.2.2 gives it nothing better to do. If light is left to a single processor, the others
/// make as many shots meanwhile, so that a window grows with processors. Where light does not fall even so, shots
/// grow without bound. The same is seen where over-shooting diverges.
pub(super) struct Progress {
    /// Shots of patches in a window.
    window: u64,
    /// What they may carry, as a part of what the window before carried.
    most: f64,
    emitted: f64,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Shots of patches in all windows that are over.
    before: u64,
    /// Those of this window.
    shots: u64,
    /// Absolute power that they carried, W.
    carried: f64,
    /// The same of the window before, if there was one.
    carried_before: Option<f64>,
    stuck: Option<NoProgress>,
}

impl Progress {
    /// What watches a run.
    pub fn of(run: &Run) -> Progress {
        let window = run.rules.shots_without_progress.unwrap_or_else(|| default_window(run));
        let emitted = run.problem.emitted_power().element_sum();
        Progress::new(window, most_carried(run.rules.shooting.overshoot), emitted)
    }

    fn new(window: u64, most: f64, emitted: f64) -> Progress {
        Progress { window, most, emitted, state: Mutex::default() }
    }

    /// Enter a shot of a source.
    pub fn shot(&self, source: &Source) {
        if source.is_of_a_patch() {
            self.patch_shot(source.power());
        }
    }

    /// Enter a shot of a patch with this power, W.
    fn patch_shot(&self, power: Rgb) {
        let mut guard = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let state = &mut *guard;
        state.shots += 1;
        state.carried += power.abs().element_sum();
        if state.shots < self.window {
            return;
        }
        state.before += std::mem::take(&mut state.shots);
        let now = std::mem::take(&mut state.carried);
        let Some(before) = state.carried_before.replace(now) else { return };
        // Light that is not a number does not fall either.
        let falls = now < self.most * before;
        if !falls && state.stuck.is_none() {
            let [before, now] = [before, now].map(|power| power / self.emitted);
            let shots = state.before;
            let Progress { window, most, .. } = *self;
            state.stuck = Some(NoProgress { shots, window, before, now, most });
        }
    }

    /// # Errors
    /// If there was no progress.
    pub fn check(&self) -> Result<(), ProgramError> {
        match &self.state.lock().unwrap_or_else(PoisonError::into_inner).stuck {
            Some(stuck) => Err(ProgramError::NoProgress(stuck.clone())),
            None => Ok(()),
        }
    }
}

/// The shots of a window where the rules say none.
fn default_window(run: &Run) -> u64 {
    let falling = shots_to_fall(&run.problem, &run.rules.shooting);
    // A cast from f64 saturates.
    (FALLS * falling * run.processors as f64).round() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_that_does_not_fall_is_noticed() {
        let falls = Progress::new(10, 0.1, 2.0);
        (0..1_000).for_each(|shot| falls.patch_shot(Rgb::splat(0.7_f64.powi(shot))));
        assert_eq!(falls.check(), Ok(()));
        let most = most_carried(1.0);
        for power in [0.0, f64::MIN_POSITIVE, -1.0, f64::INFINITY] {
            let stays = Progress::new(10, 0.1, 2.0);
            (0..19).for_each(|_| stays.patch_shot(Rgb::splat(power)));
            assert_eq!(stays.check(), Ok(()));
            stays.patch_shot(Rgb::splat(power));
            let carried = 10.0 * 3.0 * power.abs() / 2.0;
            let expected =
                NoProgress { shots: 20, window: 10, before: carried, now: carried, most };
            assert_eq!(stays.check(), Err(ProgramError::NoProgress(expected)));
        }
    }

    #[test]
    fn over_shooting_slows_the_fall() {
        assert_eq!(most_carried(1.0), 0.1);
        assert!(most_carried(1.5) < most_carried(1.9) && most_carried(1.9) < 1.0);
        assert_eq!(most_carried(6.0), 1.0);
    }

    /// Each window carries half of what the one before carried: less, but not a tenth.
    #[test]
    fn light_that_falls_ever_more_slowly_is_noticed() {
        let slows = Progress::new(10, 0.1, 1.0);
        (0..20).for_each(|shot| slows.patch_shot(Rgb::splat(0.5_f64.powi(shot / 10))));
        let error = slows.check().unwrap_err().to_string();
        assert!(error.contains("after 20 shots of patches: the last 10 of them"), "{error}");
        assert!(error.contains("1.5e3 % of the emitted power, and the 10 before these 3.0e3 %"));
    }
}
