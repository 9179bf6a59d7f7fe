//! `virtwall plot`: plots and report of saved results, drawn anew.

use std::path::PathBuf;

use clap::Args;
use lab::Results;

use crate::exit::Exit;

/// What to draw.
#[derive(Args)]
pub struct Arguments {
    /// A folder that `virtwall run` wrote
    results: PathBuf,
}

/// Draws; returns the names of the files.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let results = Results::read(&arguments.results)?;
    let names = results.draw(&arguments.results).map_err(Exit::failure)?;
    let lines = names.iter().map(|name| format!("{}\n", arguments.results.join(name).display()));
    Ok(lines.collect())
}
