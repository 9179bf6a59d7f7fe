//! `virtwall man`: manual pages of the command and of each of its commands.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::Man;

use crate::exit::Exit;
use crate::files::{make_folder, write};

#[derive(Args)]
pub struct Arguments {
    /// Folder for the pages
    #[arg(short, long, value_name = "DIR", required_unless_present = "folder")]
    output: Option<PathBuf>,
    /// The same, as it was called once
    #[arg(hide = true, conflicts_with = "output")]
    folder: Option<PathBuf>,
}

/// Writes the pages; returns their paths.
pub fn run(arguments: &Arguments, mut command: Command) -> Result<String, Exit> {
    let folder = arguments.output.iter().chain(&arguments.folder).next();
    let folder = folder.ok_or_else(|| Exit::bad_input("expected a folder for the pages"))?;
    make_folder(folder, "manual pages")?;
    command.build();
    let mut output = String::new();
    for (name, page) in pages(&command)? {
        let path = folder.join(name);
        write(&path, page)?;
        output += &format!("{}\n", path.display());
    }
    Ok(output)
}

/// The page of a command and those of the commands in it, with their file names.
fn pages(command: &Command) -> Result<Vec<(String, Vec<u8>)>, Exit> {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render(&mut page).map_err(Exit::failure)?;
    let mut all = vec![(man.get_filename(), page)];
    for inner in command.get_subcommands().filter(|inner| inner.get_name() != "help") {
        all.extend(pages(inner)?);
    }
    Ok(all)
}
