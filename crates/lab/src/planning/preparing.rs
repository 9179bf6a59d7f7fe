//! How a plan is made: host resources, and a callback for pilot runs.

/// Host resources for making a plan. None of them changes the plan, except `finding`.
pub struct Preparing<'a> {
    /// Threads that prepare scenes and search settings in parallel, at least 1.
    pub threads: usize,
    /// Host memory for shots of pilot runs, bytes.
    pub memory: usize,
    /// Whether to search the settings that an experiment leaves open; else they have their defaults.
    pub finding: bool,
    /// Called after every pilot run: scene, accuracy asked for, pilot runs made for both.
    pub on_pilot: &'a (dyn Fn(&str, f64, usize) + Sync),
}

impl Default for Preparing<'_> {
    fn default() -> Self {
        Preparing { threads: 1, memory: 1 << 28, finding: true, on_pilot: &|_, _, _| () }
    }
}
