//! `virtwall scene`: scenes.

mod flip;
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
    /// Turn polygons over to the side from which light comes; write the repaired OBJ file
    Flip(flip::Arguments),
}

pub fn run(command: &Command) -> Result<String, Exit> {
    match command {
        Command::Make(arguments) => make::run(arguments),
        Command::Show(arguments) => show::run(arguments),
        Command::Flip(arguments) => flip::run(arguments),
    }
}
