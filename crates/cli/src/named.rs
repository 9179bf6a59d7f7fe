//! Scenes, machines and experiments by name or path, whichever of them it is.

use std::path::Path;

use lab::{FileKind, Kind, find_here};

const KINDS: [(Kind, FileKind); 3] = [
    (Kind::Scene, FileKind::SCENES),
    (Kind::Machine, FileKind::MACHINES),
    (Kind::Experiment, FileKind::EXPERIMENTS),
];

/// All that a name means; at most one kind, if it is a path.
pub fn kinds_of(name: &str) -> Vec<Kind> {
    let kind_of = |(kind, folder): &(Kind, FileKind)| {
        let found = find_here(folder, name).ok()?;
        // What no folder has as a name is a path.
        if Path::new(name) == found.path { Kind::of_file(&found.path) } else { Some(*kind) }
    };
    let mut kinds: Vec<Kind> = KINDS.iter().filter_map(kind_of).collect();
    kinds.dedup();
    kinds
}

/// All names of scenes, machines and experiments here.
pub fn names() -> Vec<String> {
    let files = KINDS.iter().flat_map(|(_, folder)| lab::all_here(folder));
    let stems = files.map(|found| found.path.file_stem().unwrap_or_default().to_owned());
    stems.map(|stem| stem.to_string_lossy().into_owned()).collect()
}

/// What to say of a name or path that is no experiment, but a scene or a machine: the command that was meant.
pub fn not_an_experiment(name: &str) -> Option<String> {
    let kinds = kinds_of(name);
    let name = &if name.contains(' ') { format!("'{name}'") } else { name.to_owned() };
    let set = |field: &str| format!("virtwall run quickstart --set {field}={name}");
    let example = |field: &str| format!("name it in an experiment, for example: {}", set(field));
    match kinds.first()? {
        _ if kinds.contains(&Kind::Experiment) => None,
        Kind::Machine => Some(format!(
            "{name} is a machine; to see it: virtwall machine show {name}; to run on it, {}",
            example("machine")
        )),
        kind => Some(format!(
            "{name} is {kind}; to draw it: virtwall render {name} --output picture.png; to run it, {}",
            example("scene")
        )),
    }
}
