//! `virtwall schema`: prints the JSON Schema of a kind of file, for completion in editors.

use clap::{Args, ValueEnum};

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// The kind of file
    kind: Kind,
}

#[derive(Clone, Copy, ValueEnum)]
enum Kind {
    /// Experiment files
    Experiment,
    /// Machine descriptions
    Machine,
    /// Columns of runs.csv
    Runs,
    /// Scene descriptions
    Scene,
    /// Cases for `virtwall stability`
    Stability,
    /// Traces of messages for `virtwall machine replay`
    Trace,
}

/// Returns the schema.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let schema = match arguments.kind {
        Kind::Experiment => lab::experiment_schema(),
        Kind::Machine => multicomputer::machine_schema(),
        Kind::Runs => lab::runs_schema(),
        Kind::Scene => lab::scene_schema(),
        Kind::Stability => stability::case_schema(),
        Kind::Trace => multicomputer::trace_schema(),
    };
    let text = serde_json::to_string_pretty(&schema).map_err(Exit::failure)?;
    Ok(text + "\n")
}
