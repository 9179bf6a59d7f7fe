//! `virtwall completions`: completes the command's arguments in a shell.

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

/// The script for the shell.
pub fn run(arguments: &Arguments, mut command: Command) -> Result<String, Exit> {
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    generate(arguments.shell, &mut command, name, &mut script);
    String::from_utf8(script).map_err(Exit::failure)
}
