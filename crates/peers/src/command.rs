//! Runs programs of the host.

use std::process::{Command, Stdio};

/// The output of a program. An error has the last line of its standard error or, if the program is missing, the
/// Debian packages that contain it.
pub fn run(command: &mut Command, packages: &str) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.stderr(Stdio::piped()).output().map_err(|error| {
        format!("{name}: {error}\nTo install it on Debian: apt install {packages}")
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    Err(format!("{name}: {}", errors.lines().last().unwrap_or("it failed")))
}

/// Cargo; the one that runs this program, if one does.
pub fn cargo() -> Command {
    Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()))
}
