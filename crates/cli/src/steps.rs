//! A progress bar over steps that are counted, on standard error, and only on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// How many of some steps are done.
pub struct Steps(ProgressBar);

impl Steps {
    /// A bar for so many steps; indicatif hides it where standard error is no terminal.
    pub fn new(what: &'static str, count: usize) -> Steps {
        let bar = ProgressBar::new(count as u64);
        let style = ProgressStyle::with_template(
            "{bar:36} {pos} of {len} {msg}, {elapsed} gone, {eta} left",
        );
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_message(what);
        Steps(bar)
    }

    /// `work`, each end of which is a step done.
    pub fn counting<T>(&self, work: impl Fn(usize) -> T) -> impl Fn(usize) -> T {
        move |number| {
            let result = work(number);
            self.one();
            result
        }
    }

    /// One more is done.
    pub fn one(&self) {
        self.0.inc(1);
    }

    /// So many are done by now.
    pub fn at(&self, steps: u64) {
        self.0.set_position(steps);
    }

    /// So many were done before.
    pub fn skip(&self, steps: u32) {
        self.0.inc(u64::from(steps));
        self.0.reset_eta();
    }

    /// Takes the bar away.
    pub fn end(&self) {
        self.0.finish_and_clear();
    }
}
