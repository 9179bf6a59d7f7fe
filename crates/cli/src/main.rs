//! The `virtwall` command: arguments, progress, exit codes.
//!
//! Exit codes: 0 success; 1 a run failed; 2 bad input, and nothing was written.

mod arguments;
mod bench_rays;
mod check;
mod completions;
mod exit;
mod explain;
mod export;
mod files;
mod formfactors;
mod list;
mod live;
mod machine;
mod man;
mod named;
mod paths;
mod plot;
mod progress;
mod provenance;
mod reference;
mod render;
mod run;
mod scene;
mod schema;
mod show;
mod stability;
mod steps;
mod threads;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::exit::{Exit, print, print_note, printed};

/// Simulates an Intel Paragon XP/S running the parallel radiosity algorithm of Inria RR-3008.
#[derive(Parser)]
#[command(name = "virtwall", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run an experiment and write its results
    Run(run::Arguments),
    /// List what has a name: scenes, machines, experiments, network models, columns, fields, choices
    List(list::Arguments),
    /// Show a scene, a machine or an experiment
    Show(show::Arguments),
    /// Explain a column of results, a field of a file, a choice or a network model
    Explain(explain::Arguments),
    /// Write a built-in scene, machine or experiment into a folder, to be changed there
    Export(export::Arguments),
    /// Draw the plots and the report of saved results again
    Plot(plot::Arguments),
    /// Validate experiments, machines, traces, scenes, OBJ and MTL files; print what each is
    Check(check::Arguments),
    /// Make, show or repair a scene
    #[command(subcommand)]
    Scene(scene::Command),
    /// Show a machine, or measure its network
    #[command(subcommand)]
    Machine(machine::Command),
    /// Draw a scene, or any instant of a run, as a picture, an animation or a glTF file
    Render(render::Arguments),
    /// Compute the form factors between the objects of a scene
    Formfactors(formfactors::Arguments),
    /// Compute and store a reference solution of a scene
    Reference(reference::Arguments),
    /// Run the numerical stability cases and write their page
    Stability(stability::Arguments),
    /// Measure the speed of this host
    #[command(subcommand)]
    Bench(BenchCommand),
    /// Print the JSON Schema of a kind of file
    Schema(schema::Arguments),
    /// Print a script that completes arguments in a shell
    Completions(completions::Arguments),
    /// Write manual pages into a folder
    Man(man::Arguments),
}

#[derive(Subcommand)]
enum BenchCommand {
    /// Cast rays from random points of a scene
    Rays(bench_rays::Arguments),
}

fn main() -> ExitCode {
    let (output, failure) = match Arguments::try_parse().map(|arguments| run(&arguments.command)) {
        Err(said) if said.use_stderr() => said.exit(),
        // Help, or the version.
        Err(said) => (printed(said.print()), None),
        Ok(Ok(text)) => (print(&text), None),
        Ok(Err(exit)) => (print(&exit.output), Some(exit)),
    };
    let failures = [output.err(), failure];
    failures.iter().flatten().for_each(|exit| print_note(&format!("error: {}", exit.message)));
    ExitCode::from(failures.iter().flatten().last().map_or(0, |exit| exit.code))
}

/// Carries out a command; returns what it prints.
fn run(command: &Command) -> Result<String, Exit> {
    match command {
        Command::Run(arguments) => run::run(arguments),
        Command::List(arguments) => list::run(arguments),
        Command::Show(arguments) => show::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Plot(arguments) => plot::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Scene(command) => scene::run(command),
        Command::Machine(command) => machine::run(command),
        Command::Render(arguments) => render::run(arguments),
        Command::Formfactors(arguments) => formfactors::run(arguments),
        Command::Reference(arguments) => reference::run(arguments),
        Command::Stability(arguments) => stability::run(arguments),
        Command::Bench(BenchCommand::Rays(arguments)) => bench_rays::run(arguments),
        Command::Schema(arguments) => schema::run(arguments),
        Command::Completions(arguments) => completions::run(arguments, Arguments::command()),
        Command::Man(arguments) => man::run(arguments, Arguments::command()),
    }
}
