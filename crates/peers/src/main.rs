//! Our rates beside those of the programs that others would use for the same.

mod caches;
mod callgrind;
mod command;
mod cpu;
#[path = "../../multicomputer/benches/exchange/mod.rs"]
mod exchange;
mod function;
mod host;
mod messages;
mod peer;
mod perf;
mod profile;
mod rays;
mod record;
mod scenes;
mod shots;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Measures this project beside its peers, on this host, one thread each.
#[derive(Parser)]
#[command(name = "peers")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Cast the same rays with our kernel and with Embree, in turns.
    Rays {
        /// Names or OBJ files of scenes; by default rooms of two sizes and the paper's three.
        scenes: Vec<PathBuf>,
        #[command(flatten)]
        rounds: Rounds,
    },
    /// Send the same messages over our networks and over SimGrid's, in turns.
    Messages {
        #[command(flatten)]
        rounds: Rounds,
    },
    /// Sample and count where the time goes, in Table 1 and in the kernel.
    Profile,
    /// Hold the model of a processor's caches against valgrind's count of misses.
    Caches {
        /// The machine whose caches they are.
        #[arg(default_value = "ultra1")]
        machine: String,
        /// Folder for the figures; none are kept without it.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Shoot lights natively, for valgrind to watch.
    #[command(hide = true)]
    Shots {
        /// The scene.
        scene: String,
        /// Local environments.
        environments: u32,
    },
    /// Do all of this, and `cargo bench`, and write it down.
    Record {
        /// Folder for the figures.
        #[arg(long, value_name = "DIR", default_value = "results/benchmarks")]
        out: PathBuf,
        #[command(flatten)]
        rounds: Rounds,
    },
}

#[derive(clap::Args)]
struct Rounds {
    /// Rounds, of which the median is told.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    rounds: u16,
}

fn main() -> ExitCode {
    match run(&Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(command: &Command) -> Result<(), String> {
    match command {
        Command::Rays { scenes, rounds } => {
            let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
            let embree = rays::EMBREE.build()?;
            for scene in scenes::scenes(scenes, &folder)? {
                let rows = rays::measure(&embree, &scene, rounds.rounds)?;
                print!("{}", rays::table(&rows));
            }
        }
        Command::Messages { rounds } => {
            let rows = messages::measure(&messages::SIMGRID.build()?, rounds.rounds)?;
            print!("{}", messages::table(&rows));
        }
        Command::Caches { machine, out } => {
            let rows = caches::measure(machine)?;
            print!("{}", caches::table(&rows));
            if let Some(out) = out {
                record::write(out, "caches.csv", &record::csv(&rows)?)?;
                record::write(out, "README.md", &caches::readme(&rows)?)?;
            }
        }
        Command::Shots { scene, environments } => caches::native(scene, *environments)?,
        Command::Record { out, rounds } => record::record(out, rounds.rounds)?,
        Command::Profile => {
            let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
            print!("{}", profile::table(&profile::measure(&folder)?));
        }
    }
    Ok(())
}
