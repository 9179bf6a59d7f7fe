//! `virtwall check`: validates files.

use std::path::{Path, PathBuf};

use clap::Args;
use config::Fault;
use lab::Checked;

use crate::exit::{Exit, print_warnings};

#[derive(Args)]
pub struct Arguments {
    /// Experiments, machines, traces, scenes, OBJ files or stability cases
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Validates all files; returns the kind of each.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let mut output = String::new();
    let (mut faults, mut warnings) = (Vec::new(), Vec::new());
    for file in &arguments.files {
        match check(file) {
            Ok(Checked { what, warnings: found }) => {
                output += &format!("{}: {what}\n", file.display());
                warnings.extend(found);
            }
            Err(fault) => faults.push(fault.to_string()),
        }
    }
    print_warnings(&warnings);
    if faults.is_empty() {
        return Ok(output);
    }
    Err(Exit { code: 2, output, message: faults.join("\nerror: ") })
}

fn check(file: &Path) -> Result<Checked, Fault> {
    if stability::is_case(file) { Ok(stability::check(file)?.into()) } else { lab::check(file) }
}
