//! What may be used to make a plan ready.

/// How a plan is made ready. None of it changes the plan.
pub struct Preparing<'a> {
    /// Threads that make scenes ready and find knobs side by side, at least 1.
    pub threads: usize,
    /// Host memory for shots of pilot runs, bytes.
    pub memory: usize,
    /// Whether to find the knobs that an experiment leaves open; else they stand at their defaults.
    pub finding: bool,
    /// Hears of every pilot run: scene, accuracy asked for, pilot runs made for both.
    pub on_pilot: &'a (dyn Fn(&str, f64, usize) + Sync),
}

impl Default for Preparing<'_> {
    fn default() -> Self {
        Preparing { threads: 1, memory: 1 << 28, finding: true, on_pilot: &|_, _, _| () }
    }
}
