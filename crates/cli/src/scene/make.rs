//! `virtwall scene make`: writes the scenes of RR-3008, section 5.1, and small ones.

use std::path::PathBuf;

use clap::Args;
use scenemaker::{MOST_TABLES, SceneKind, SceneText};

use crate::exit::Exit;
use crate::files::{check_writable, make_folder, write};

#[derive(Args)]
pub struct Arguments {
    /// office, rooms or building (the paper's), room4, corridor, hole or cornell (small ones)
    kind: SceneKind,
    /// Floors of the building [default: 5]; its files are then called building-N
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=1000))]
    floors: Option<u16>,
    /// Seed of random choices
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
    /// Tables in each of the rooms [default: 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(..=i64::from(MOST_TABLES)))]
    tables: Option<u32>,
    /// Folder for the OBJ and MTL files
    #[arg(short, long = "output", alias = "out", value_name = "DIR", default_value = "scenes")]
    out: PathBuf,
}

/// Writes the files; returns their paths.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let out = &arguments.out;
    make_folder(out, "scenes")?;
    let text = text(arguments)?;
    let path = |ending: &str| out.join(format!("{}.{ending}", text.name));
    let files = [(path("obj"), &text.obj), (path("mtl"), &text.mtl)];
    files.iter().try_for_each(|(path, _)| check_writable(path))?;
    let mut output = String::new();
    for (path, contents) in files {
        write(&path, contents)?;
        output += &format!("{}\n", path.display());
    }
    Ok(output)
}

fn text(arguments: &Arguments) -> Result<SceneText, Exit> {
    let seed = arguments.seed;
    match (arguments.kind, arguments.floors, arguments.tables) {
        (kind, None, None) => Ok(scenemaker::make(kind, seed)),
        (SceneKind::Rooms, None, Some(tables)) => Ok(scenemaker::make_rooms(tables, seed)),
        (SceneKind::Building, Some(floors), None) => scenemaker::make_building(floors, seed)
            .ok_or_else(|| Exit::bad_input(format!("{floors} floors; expected 2 to 1000"))),
        (kind, Some(_), _) => {
            Err(Exit::bad_input(format!("--floors: found {kind}; expected building")))
        }
        (kind, _, Some(_)) => {
            Err(Exit::bad_input(format!("--tables: found {kind}; expected rooms")))
        }
    }
}
