//! Compares the speed of this project with other programs: rays with Embree, messages with SimGrid, cache misses
//! with valgrind.

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

/// Compares this project with other programs on this host, one thread each.
#[derive(Parser)]
#[command(name = "peers")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Cast the same rays with this kernel and with Embree, in turns.
    Rays {
        /// Names or OBJ files of scenes; by default rooms of two sizes and the paper's three.
        scenes: Vec<PathBuf>,
        #[command(flatten)]
        rounds: Rounds,
    },
    /// Send the same messages over these network models and over SimGrid's, in turns.
    Messages {
        #[command(flatten)]
        rounds: Rounds,
    },
    /// Profile Table 1 and the kernel with perf and valgrind.
    Profile,
    /// Compare the cache model with valgrind's count of misses.
    Caches {
        /// The machine that has the caches.
        #[arg(default_value = "ultra1")]
        machine: String,
        /// Folder for the results; without it they are only printed.
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Shoot lights natively; valgrind runs this.
    #[command(hide = true)]
    Shots {
        /// The scene.
        scene: String,
        /// Local environments.
        environments: u32,
    },
    /// Run all comparisons but the caches, and `cargo bench`, and write the results.
    Record {
        /// Folder for the results.
        #[arg(long, value_name = "DIR", default_value = "results/benchmarks")]
        out: PathBuf,
        #[command(flatten)]
        rounds: Rounds,
    },
}

#[derive(clap::Args)]
struct Rounds {
    /// Number of rounds; the median is reported.
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
