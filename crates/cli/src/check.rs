//! `virtwall check`: validates files.

use std::path::{Path, PathBuf};

use clap::Args;
use config::Fault;

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// Experiments, machines, traces, scenes, OBJ files or stability cases
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Validates all files; returns the kind of each.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let mut output = String::new();
    let mut faults = Vec::new();
    for file in &arguments.files {
        match check(file) {
            Ok(kind) => output += &format!("{}: {kind}\n", file.display()),
            Err(fault) => faults.push(fault.to_string()),
        }
    }
    if faults.is_empty() {
        return Ok(output);
    }
    Err(Exit { code: 2, output, message: faults.join("\nerror: ") })
}

fn check(file: &Path) -> Result<String, Fault> {
    if stability::is_case(file) { stability::check(file) } else { lab::check(file) }
}
