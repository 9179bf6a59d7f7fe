//! Which of the kinds of files with names a file is.

use std::fmt;
use std::path::Path;

use config::Document;
use serde_json::Value;

use crate::open::scene::is_obj;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An experiment.
    Experiment,
    /// A scene description.
    Scene,
    /// The geometry of a scene.
    Obj,
    /// A machine.
    Machine,
}

impl Kind {
    /// The kind of a JSON file that says this; none if it is another one.
    pub fn of(value: &Value) -> Option<Kind> {
        let has = |keys: &[&str]| keys.iter().any(|key| value.get(key).is_some());
        match () {
            () if has(&["scene", "plots"]) => Some(Kind::Experiment),
            () if has(&["obj", "made"]) => Some(Kind::Scene),
            () if has(&["processor", "network", "extends"]) => Some(Kind::Machine),
            () => None,
        }
    }

    /// The kind of the file at a path; none if it is another one, or cannot be read.
    pub fn of_file(path: &Path) -> Option<Kind> {
        if is_obj(path) {
            return Some(Kind::Obj);
        }
        Kind::of(&Document::read(path).ok()?.value)
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Experiment => "an experiment",
            Kind::Scene => "a scene",
            Kind::Obj => "the geometry of a scene",
            Kind::Machine => "a machine",
        })
    }
}
