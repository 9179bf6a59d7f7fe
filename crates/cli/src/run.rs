//! `virtwall run`: an experiment, from its file to its results.

use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use lab::{HostClock, On, Options, Plan, Results};

use crate::exit::Exit;
use crate::progress::Progress;

/// What to run, and how.
#[derive(Args)]
pub struct Arguments {
    /// The experiment file. Scenes and machines that it names are looked up in scenes/ and
    /// machines/ beside its folder, then in the current folder.
    file: PathBuf,
    /// Folder for the results [default: results/<name of the experiment file>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Runs side by side [default: one for each of this host's processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Put a value in the place of the file's, such as stop.patch_threshold="5 %" or
    /// processors=[1,2]; a list sweeps
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Model of the network: ideal, loggp, wormhole, flit, or auto, the cheapest that will do;
    /// short for --set network=RUNG
    #[arg(long, value_name = "RUNG")]
    network: Option<String>,
    /// What the programs run on
    #[arg(long, value_enum, default_value = "simulation")]
    on: OnArgument,
    /// Forget the runs that an interrupted sweep has finished
    #[arg(long)]
    fresh: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum OnArgument {
    /// The simulated machine: virtual time, the same on every host
    Simulation,
    /// Threads of this host: the same light, no virtual time
    Threads,
}

/// Runs the experiment; returns the table of its results.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let clock = HostClock::start();
    let network = arguments.network.iter().map(|rung| format!("network={rung}"));
    let set: Vec<String> = arguments.set.iter().cloned().chain(network).collect();
    let plan = Arc::new(Plan::read(&arguments.file, &set)?);
    let default = || PathBuf::from("results").join(&plan.name);
    let out = arguments.out.clone().unwrap_or_else(default);
    let place = out.display();
    std::fs::create_dir_all(&out)
        .map_err(|error| Exit::bad_input(format!("{place}: no folder for results: {error}")))?;

    let threads = arguments.threads.map_or_else(host_processors, usize::from);
    let on = match arguments.on {
        OnArgument::Simulation => On::Simulation,
        OnArgument::Threads => On::Threads,
    };
    let options = Options { threads, fresh: arguments.fresh, on };
    let progress = Arc::new(Progress::new(Arc::clone(&plan)));
    let watch = {
        let progress = Arc::clone(&progress);
        Arc::new(move |event| progress.note(event))
    };
    let endings = lab::carry_out(&plan, &out, options, watch).map_err(Exit::failure)?;
    progress.end();

    let results = Results::of(&plan, &endings, options).map_err(Exit::failure)?;
    results.write(&out).map_err(Exit::failure)?;
    lab::write_host_times(&out, &endings, clock.seconds(), threads).map_err(Exit::failure)?;
    let networks = lab::networks_text(&plan, &endings);
    let (title, table) = (&plan.title, results.text());
    let output = format!("{title}\n{table}\n{networks}Results are in {place}.\n");
    match results.failures() {
        0 => Ok(output),
        failures => {
            let message = format!("{failures} of {} runs failed", plan.runs.len());
            Err(Exit { code: 1, output, message })
        }
    }
}

fn host_processors() -> usize {
    std::thread::available_parallelism().map_or(1, |processors| processors.get())
}
