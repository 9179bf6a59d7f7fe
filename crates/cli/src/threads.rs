//! The argument `--threads`.

use clap::Args;

#[derive(Args)]
pub struct Threads {
    /// Threads [default: one per processor of this host]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl Threads {
    pub fn count(&self) -> usize {
        self.threads.map_or_else(parallel::host_threads, usize::from)
    }
}
