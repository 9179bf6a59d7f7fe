//! `virtwall scene`: scenes.

mod make;
mod show;

use clap::Subcommand;

pub use self::show::{meshed, show};
use crate::exit::Exit;

#[derive(Subcommand)]
pub enum Command {
    /// Write one of the scenes of RR-3008 (section 5.1) or a small one, as OBJ and MTL files
    Make(make::Arguments),
    /// Print what a scene contains, and draw it
    Show(show::Arguments),
}

pub fn run(command: &Command) -> Result<String, Exit> {
    match command {
        Command::Make(arguments) => make::run(arguments),
        Command::Show(arguments) => show::run(arguments),
    }
}
