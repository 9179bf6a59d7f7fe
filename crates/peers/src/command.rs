//! Other programs that are there already.

use std::process::{Command, Stdio};

/// What a program prints, if all goes well; else what it complains of last, and the packages of Debian
/// with it if it is not there.
pub fn run(command: &mut Command, packages: &str) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.stderr(Stdio::piped()).output().map_err(|error| {
        format!("{name}: {error}\nOn Debian, what is needed comes with: apt install {packages}")
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let complaints = String::from_utf8_lossy(&output.stderr);
    Err(format!("{name}: {}", complaints.lines().last().unwrap_or("it failed")))
}

/// Cargo, the one that runs us if one does.
pub fn cargo() -> Command {
    Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned()))
}
