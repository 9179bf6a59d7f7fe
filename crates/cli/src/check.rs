//! `virtwall check`: files, validated.

use std::path::PathBuf;

use clap::Args;

use crate::exit::Exit;

/// What to validate.
#[derive(Args)]
pub struct Arguments {
    /// Experiment, machine, trace, scene or OBJ files
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Validates all files; returns what each is.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let mut output = String::new();
    let mut faults = Vec::new();
    for file in &arguments.files {
        match lab::check(file) {
            Ok(what) => output += &format!("{}: {what}\n", file.display()),
            Err(fault) => faults.push(fault.to_string()),
        }
    }
    if faults.is_empty() {
        return Ok(output);
    }
    Err(Exit { code: 2, output, message: faults.join("\nerror: ") })
}
