//! `virtwall scene make`: the scenes of RR-3008, section 5.1.

use std::path::PathBuf;

use clap::Args;
use scenemaker::SceneKind;

use crate::exit::Exit;

/// What to make.
#[derive(Args)]
pub struct Arguments {
    /// office, rooms or building
    kind: SceneKind,
    /// Seed of what is drawn at random
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
    /// Folder for the OBJ and MTL files
    #[arg(long, value_name = "DIR", default_value = "scenes")]
    out: PathBuf,
}

/// Writes the files; returns their names.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let out = &arguments.out;
    std::fs::create_dir_all(out)
        .map_err(|error| Exit::bad_input(format!("{}: no folder: {error}", out.display())))?;
    let text = scenemaker::make(arguments.kind, arguments.seed);
    let mut output = String::new();
    for (ending, contents) in [("obj", &text.obj), ("mtl", &text.mtl)] {
        let path = out.join(format!("{}.{ending}", arguments.kind.name()));
        lab::write_file(&path, contents.as_bytes()).map_err(Exit::failure)?;
        output += &format!("{}\n", path.display());
    }
    Ok(output)
}
