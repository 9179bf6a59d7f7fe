//! `virtwall machine`: machines and their networks.

mod bench;
mod compare;
mod network;
mod replay;
mod show;

use clap::Subcommand;

pub use self::show::show;
use crate::exit::Exit;

#[derive(Subcommand)]
pub enum Command {
    /// Print a machine, the provenance of its numbers, and a drawing of it
    Show(show::Arguments),
    /// Measure a machine's network: ping-pong, exchange and hot spot, by message size
    Bench(bench::Arguments),
    /// Compare the wormhole model of a machine's network with the flit model, under synthetic traffic
    Compare(compare::Arguments),
    /// Send the messages of a trace file over a machine's network; print when each of them arrives
    Replay(replay::Arguments),
}

pub fn run(command: &Command) -> Result<String, Exit> {
    match command {
        Command::Show(arguments) => show::run(arguments),
        Command::Bench(arguments) => bench::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Replay(arguments) => replay::run(arguments),
    }
}
