//! `virtwall export`: writes a built-in scene, machine or experiment into a folder, to be changed there.

use std::path::{Path, PathBuf};

use clap::Args;
use config::{Document, unknown};

use crate::exit::Exit;
use crate::files::{make_folder, write};

#[derive(Args)]
pub struct Arguments {
    /// Name of a built-in scene, machine or experiment, as `virtwall list` prints it
    name: String,
    /// Folder in which the file is put, below scenes/, machines/ or experiments/
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    output: PathBuf,
    /// The same, as it was called once
    #[arg(hide = true, conflicts_with = "output")]
    folder: Option<PathBuf>,
}

const FOLDERS: [&str; 3] = ["scenes", "machines", "experiments"];

/// Writes the files; returns their names.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let built_in = |folder: &str| shipped::json_files(&Path::new(shipped::ROOT).join(folder));
    let all: Vec<PathBuf> = FOLDERS.iter().flat_map(|folder| built_in(folder)).collect();
    let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let named: Vec<&PathBuf> = all.iter().filter(|path| stem(path) == arguments.name).collect();
    if named.is_empty() {
        let known: Vec<String> = all.iter().map(|path| stem(path)).collect();
        return Err(Exit::bad_input(unknown("built-in file", &arguments.name, &known)));
    }
    let mut files = Vec::new();
    for path in named {
        files.push(path.clone());
        files.extend(geometry(path)?);
    }
    let folder = arguments.folder.as_ref().unwrap_or(&arguments.output);
    let copies: Vec<PathBuf> = files
        .iter()
        .map(|path| folder.join(path.strip_prefix(shipped::ROOT).unwrap_or(path)))
        .collect();
    if let Some(there) = copies.iter().find(|copy| copy.exists()) {
        let message = format!("{}: exists already; expected a folder without it", there.display());
        return Err(Exit::bad_input(message));
    }
    let mut output = String::new();
    for (file, copy) in files.iter().zip(&copies) {
        make_folder(copy.parent().unwrap_or(copy), "the file")?;
        write(copy, shipped::file(file).unwrap_or_default())?;
        output += &format!("{}\n", copy.display());
    }
    Ok(output)
}

/// The OBJ and MTL files of a scene description.
fn geometry(path: &Path) -> Result<Vec<PathBuf>, Exit> {
    let document = Document::read(path)?;
    let obj = document.value["obj"].as_str().map(|name| path.with_file_name(name));
    let files = obj.into_iter().flat_map(|obj| [obj.with_extension("mtl"), obj]);
    Ok(files.filter(|path| shipped::file(path).is_some()).collect())
}
