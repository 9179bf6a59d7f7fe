//! Scenes, machines and experiments by name or path, whichever of them it is.

use std::path::Path;

use lab::{FileKind, Kind, find_here};

/// A file with a name, and what it is.
pub struct Named {
    pub kind: Kind,
}

const KINDS: [(Kind, FileKind); 3] = [
    (Kind::Scene, FileKind::SCENES),
    (Kind::Machine, FileKind::MACHINES),
    (Kind::Experiment, FileKind::EXPERIMENTS),
];

impl Named {
    /// All that a name means; at most one file, if it is a path.
    pub fn all(name: &str) -> Vec<Named> {
        let named = |(kind, folder): &(Kind, FileKind)| {
            let found = find_here(folder, name).ok()?;
            // What no folder has as a name is a path.
            let of_file = || Kind::of_file(&found.path);
            let kind = if is_path(name, &found.path) { of_file()? } else { *kind };
            Some(Named { kind })
        };
        let mut all: Vec<Named> = KINDS.iter().filter_map(named).collect();
        all.dedup_by_key(|named| named.kind);
        all
    }
}

fn is_path(name: &str, found: &Path) -> bool {
    Path::new(name) == found
}

/// All names of scenes, machines and experiments here.
pub fn names() -> Vec<String> {
    let files = KINDS.iter().flat_map(|(_, folder)| lab::all_here(folder));
    let stems = files.map(|found| found.path.file_stem().unwrap_or_default().to_owned());
    stems.map(|stem| stem.to_string_lossy().into_owned()).collect()
}

/// What to say of a name or path that is no experiment, but a scene or a machine: the command that was meant.
pub fn not_an_experiment(name: &str) -> Option<String> {
    let kinds: Vec<Kind> = Named::all(name).into_iter().map(|named| named.kind).collect();
    let set = |field: &str| format!("virtwall run quickstart --set {field}={name}");
    match kinds.first()? {
        Kind::Experiment => None,
        kind @ (Kind::Scene | Kind::Obj) => Some(format!(
            "{name} is {kind}; to draw it: virtwall render {name} --output picture.png; to run it, name it \
             in an experiment, for example: {}",
            set("scene")
        )),
        kind @ Kind::Machine => Some(format!(
            "{name} is {kind}; to see it: virtwall machine show {name}; to run on it, name it in an \
             experiment, for example: {}",
            set("machine")
        )),
    }
}
