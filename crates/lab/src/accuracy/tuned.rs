//! A setting that was found, and the error and time predicted for it.

use crate::accuracy::pilot::Knobs;
use crate::engine::error_figures::Causes;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuned {
    pub target: f64,
    pub knobs: Knobs,
    /// Its error, as witnesses estimate it.
    pub error: f64,
    /// The standard error of that estimate.
    pub deviation: f64,
    /// Its parts, as the laws predict them.
    pub predicted: Causes,
    /// Its virtual time on one processor, seconds.
    pub time_s: f64,
    /// The least time of a sweep's runs below the target, if there is such a sweep, seconds.
    pub sweep_time_s: Option<f64>,
    pub pilots: usize,
}

impl Tuned {
    pub fn sentence(&self, scene: &str) -> String {
        let percent = |share: f64| format!("{:.2} %", 100.0 * share);
        let causes =
            self.predicted.named().map(|(name, error)| format!("{name} {}", percent(error)));
        format!(
            "{scene} to {}: {}. Predicted error {:.2} ± {} ({}), {:.0} s on one processor; {} pilot runs.",
            percent(self.target),
            self.knobs,
            100.0 * self.error,
            percent(self.deviation),
            causes.join(", "),
            self.time_s,
            self.pilots,
        )
    }
}
