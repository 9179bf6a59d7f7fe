//! The path to a value in a JSON document, for messages.

use std::fmt;

use serde_path_to_error::{Path, Segment};

/// One step from a JSON value to a value inside it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Step {
    /// Into an object.
    Key(String),
    /// Into a list, from 0.
    Item(usize),
}

/// The way from a document's root to a value: `hemisphere.pixels[2]`.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place(pub Vec<Step>);

impl Place {
    /// The place of a dotted path of keys; an empty one is the document's root.
    pub fn of(dotted: &str) -> Place {
        let keys = dotted.split('.').filter(|key| !key.is_empty());
        Place(keys.map(|key| Step::Key(key.to_owned())).collect())
    }

    /// The place of `key` inside this one.
    pub fn key(&self, key: &str) -> Place {
        self.with(Step::Key(key.to_owned()))
    }

    /// The place of item `index` inside this one.
    pub fn item(&self, index: usize) -> Place {
        self.with(Step::Item(index))
    }

    /// Whether `self` is `other` or stands around it.
    pub fn holds(&self, other: &Place) -> bool {
        other.0.starts_with(&self.0)
    }

    /// The place to which `rest` leads from this one.
    pub fn join(&self, rest: &Place) -> Place {
        Place(self.0.iter().chain(&rest.0).cloned().collect())
    }

    fn with(&self, step: Step) -> Place {
        Place(self.0.iter().cloned().chain([step]).collect())
    }
}

impl From<&Path> for Place {
    fn from(path: &Path) -> Place {
        let steps = path.iter().filter_map(|segment| match segment {
            Segment::Seq { index } => Some(Step::Item(*index)),
            Segment::Map { key } => Some(Step::Key(key.clone())),
            Segment::Enum { .. } | Segment::Unknown => None,
        });
        Place(steps.collect())
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Key(key) if i == 0 => write!(f, "{key}")?,
                Step::Key(key) => write!(f, ".{key}")?,
                Step::Item(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}
