//! `virtwall scene flip`: writes a scene whose fronts are where its light falls.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use lab::{Flipped, flip, percent};

use crate::exit::{Exit, print_note};
use crate::files::{check_writable, write};

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, or path to a scene description (.json) or an OBJ file. Lamps stay as they are, unless
    /// all their light leaves the scene
    scene: String,
    /// Write this OBJ file; its material files are looked for next to it
    #[arg(short, long, value_name = "OBJ", value_parser = obj)]
    output: PathBuf,
}

/// Writes the file; returns what was turned over.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let output = &arguments.output;
    check_writable(output)?;
    let Flipped { text, of, materials, faces, turned, unlit, backs } = flip(&arguments.scene)?;
    if is_same(&of, output) {
        let message = "the OBJ file of the scene; expected another one, so that it is not lost";
        return Err(Exit::bad_input(format!("{}: {message}", output.display())));
    }
    write(output, text)?;
    let folder = |path: &Path| {
        fs::canonicalize(path.parent().filter(|p| *p != Path::new("")).unwrap_or(Path::new(".")))
    };
    for file in materials.iter().filter(|file| folder(file).ok() != folder(output).ok()) {
        print_note(&format!(
            "warning: {}: materials are looked for next to it: copy {} there",
            output.display(),
            file.display()
        ));
    }
    let [before, after] = backs.map(percent);
    let left = match unlit {
        0 => String::new(),
        count => format!("; {count} that no light reaches stay as they are"),
    };
    Ok(format!(
        "{turned} of {faces} faces turned over{left}\n\
         light of the lamps on backs: {before} before, {after} in {}\n",
        output.display()
    ))
}

fn is_same(a: &Path, b: &Path) -> bool {
    fs::canonicalize(a).is_ok_and(|a| fs::canonicalize(b).is_ok_and(|b| a == b))
}

fn obj(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_obj = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
    if is_obj { Ok(path) } else { Err("expected a file name that ends in .obj".to_owned()) }
}
