//! `virtwall check`: validates files.

use std::path::{Path, PathBuf};

use clap::Args;
use config::{Document, Fault};
use lab::{Checked, Kind};

use crate::exit::{Exit, print_warnings};
use crate::paths;

#[derive(Args)]
pub struct Arguments {
    /// Experiments, machines, traces, scenes, OBJ and MTL files or stability cases; folders, for the JSON, OBJ, MTL
    /// and GOAL files in them; patterns such as 'scenes/*.obj'
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Validates all files; returns the kind of each.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let mut output = String::new();
    let (mut faults, mut warnings) = (Vec::new(), Vec::new());
    let mut files = Vec::new();
    for argument in &arguments.files {
        match paths::files(argument, is_known) {
            Ok(found) => files.extend(found),
            Err(fault) => faults.push(fault),
        }
    }
    for file in &files {
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

/// Whether a file of a folder is one to check: by its ending, and not JSON of another kind, such as a schema.
fn is_known(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let is_other = || {
        let value = Document::read(path).map(|document| document.value);
        let other = value.is_ok_and(|value| !value.is_array() && Kind::of(&value).is_none());
        other && !stability::is_case(path)
    };
    match ending.as_str() {
        "obj" | "mtl" | "goal" => true,
        "json" => !is_other(),
        _ => false,
    }
}
