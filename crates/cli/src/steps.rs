//! A progress bar over a number of steps, on standard error, shown only on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

pub struct Steps(ProgressBar);

impl Steps {
    /// A bar of `count` steps; `what` names them, such as "cases".
    pub fn new(what: &'static str, count: usize) -> Steps {
        let bar = ProgressBar::new(count as u64);
        let style = ProgressStyle::with_template(
            "{bar:36} {pos} of {len} {msg}, {elapsed} elapsed, {eta} left",
        );
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_message(what);
        Steps(bar)
    }

    /// Wraps work on numbered items so that each finished item counts as a step.
    pub fn counting<T>(&self, work: impl Fn(usize) -> T) -> impl Fn(usize) -> T {
        move |number| {
            let result = work(number);
            self.one();
            result
        }
    }

    /// A bar of the light that is shot, until at most the share `unshot` is left; and what shows the share.
    pub fn of_light(unshot: f64) -> (Steps, impl Fn(f64)) {
        let steps = Steps::new("% of the light", (100.0 * (1.0 - unshot)) as usize);
        let bar = steps.0.clone();
        (steps, move |left: f64| bar.set_position((100.0 * (1.0 - left)) as u64))
    }

    /// A count of shots, whose number is not known in advance.
    pub fn of_shots() -> Steps {
        let bar = ProgressBar::no_length();
        let style = ProgressStyle::with_template("{spinner} {pos} shots, {elapsed} elapsed");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        Steps(bar)
    }

    /// Counts a step at each call, on any thread.
    pub fn counter(&self) -> impl Fn() + Send + Sync + 'static {
        let bar = self.0.clone();
        move || bar.inc(1)
    }

    pub fn one(&self) {
        self.0.inc(1);
    }

    /// Counts steps that were done in an earlier run. The estimate of the time left ignores them.
    pub fn skip(&self, steps: u32) {
        self.0.inc(u64::from(steps));
        self.0.reset_eta();
    }

    pub fn end(&self) {
        self.0.finish_and_clear();
    }
}
