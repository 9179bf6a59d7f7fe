//! `virtwall plot`: draws the plots and the report of saved results again.

use std::path::PathBuf;

use clap::Args;
use lab::Results;

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// A folder that `virtwall run` wrote. Its plots are those that the experiment file asks for now, or, if that
    /// file is of another configuration now, those of manifest.json
    results: PathBuf,
}

/// Draws; returns the paths of the files.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let mut results = Results::read(&arguments.results)?;
    eprintln!("{}", results.take_present_plots(&arguments.results)?);
    let names = results.present_in(&arguments.results).map_err(Exit::failure)?;
    let lines = names.iter().map(|name| format!("{}\n", arguments.results.join(name).display()));
    Ok(lines.collect())
}
