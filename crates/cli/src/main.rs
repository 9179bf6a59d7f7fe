//! The `virtwall` command: arguments, progress, exit codes.
//!
//! Exit codes: 0 all is well; 1 a run failed; 2 bad input, and nothing was written.

mod bench_rays;
mod check;
mod exit;
mod formfactors;
mod live;
mod machine_bench;
mod machine_compare;
mod machine_replay;
mod machine_show;
mod make_reference;
mod plot;
mod progress;
mod render;
mod run;
mod scene_make;
mod scene_show;
mod schema;
mod stability;
mod steps;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::exit::{Exit, say};

/// Simulates an Intel Paragon XP/S running the parallel radiosity algorithm of Inria RR-3008.
#[derive(Parser)]
#[command(name = "virtwall", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run an experiment and write its results.
    Run(run::Arguments),
    /// Draw the plots and the report of saved results anew.
    Plot(plot::Arguments),
    /// Validate experiments, machines, traces, scenes and OBJ files, and say what each is.
    Check(check::Arguments),
    /// Make a scene of the paper, or look at any scene.
    #[command(subcommand)]
    Scene(SceneCommand),
    /// Look at machines, and try their networks.
    #[command(subcommand)]
    Machine(MachineCommand),
    /// Draw a scene, or any instant of a run, as a picture, an animation or a glTF file.
    Render(render::Arguments),
    /// Find the form factors between the objects of any scene.
    Formfactors(formfactors::Arguments),
    /// Solve a scene as exactly as can be, and store the answer for others to be held against.
    Reference(make_reference::Arguments),
    /// Try the cases in which such methods fail, and draw the page of failures.
    Stability(stability::Arguments),
    /// Measure how fast this host is.
    #[command(subcommand)]
    Bench(BenchCommand),
    /// Print the JSON Schema of a kind of file.
    Schema(schema::Arguments),
}

#[derive(Subcommand)]
enum BenchCommand {
    /// Cast rays from random points of any scene.
    Rays(bench_rays::Arguments),
}

#[derive(Subcommand)]
enum MachineCommand {
    /// Print a machine with the provenance of its numbers, and draw it.
    Show(machine_show::Arguments),
    /// Measure a machine's network: ping-pong, exchange and hot spot, against message size.
    Bench(machine_bench::Arguments),
    /// Hold the wormhole model of a machine's network against flits, under synthetic traffic.
    Compare(machine_compare::Arguments),
    /// Send traffic of your own over a machine's network, and print the course of every message.
    Replay(machine_replay::Arguments),
}

#[derive(Subcommand)]
enum SceneCommand {
    /// Write a scene of RR-3008, section 5.1, as OBJ and MTL files.
    Make(scene_make::Arguments),
    /// Print what a scene holds, and draw it.
    Show(scene_show::Arguments),
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Scene(SceneCommand::Make(arguments)) => scene_make::run(&arguments),
        Command::Scene(SceneCommand::Show(arguments)) => scene_show::run(&arguments),
        Command::Machine(MachineCommand::Show(arguments)) => machine_show::run(&arguments),
        Command::Machine(MachineCommand::Bench(arguments)) => machine_bench::run(&arguments),
        Command::Machine(MachineCommand::Compare(arguments)) => machine_compare::run(&arguments),
        Command::Machine(MachineCommand::Replay(arguments)) => machine_replay::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Formfactors(arguments) => formfactors::run(&arguments),
        Command::Reference(arguments) => make_reference::run(&arguments),
        Command::Stability(arguments) => stability::run(&arguments),
        Command::Bench(BenchCommand::Rays(arguments)) => bench_rays::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
    };
    match done {
        Ok(text) => {
            say(&text);
            ExitCode::SUCCESS
        }
        Err(Exit { code, output, message }) => {
            say(&output);
            exit::complain(&message);
            ExitCode::from(code)
        }
    }
}
