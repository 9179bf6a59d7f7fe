//! A case as its file says it.

use std::path::Path;

use lab::{Document, Fault};
use schemars::{JsonSchema, Schema, SchemaGenerator, generate::SchemaSettings, json_schema};
use serde::Deserialize;
use serde_json::{Map, Value};

use crate::change::Change;
use crate::right::Right;
use crate::twin::Twin;

/// A failure, and how it is seen that it does not happen here.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Virtwall stability case")]
pub struct Case {
    /// Where this schema lies, for editors.
    #[serde(rename = "$schema", default)]
    #[allow(dead_code, reason = "for editors")]
    schema: Option<String>,
    /// What fails, in a line.
    pub title: String,
    /// Why it fails where nobody takes care.
    pub failure: String,
    /// What is done about it here.
    pub remedy: String,
    /// Which list of failures names it.
    pub listed: Listed,
    /// An experiment without its title, as it would stand one folder up; what it sweeps are runs of the
    /// case.
    #[schemars(schema_with = "object")]
    pub experiment: Value,
    /// The scene, changed: each makes the case's runs once more.
    #[serde(default)]
    pub changes: Vec<Change>,
    /// Rays to cast on each run's scene, about; the naive twin casts up to 200,000 of them. Default:
    /// those of every patch.
    #[serde(default)]
    pub rays: Option<u64>,
    /// Whether rays come from lamps alone, in place of all patches.
    #[serde(default)]
    pub lamps_only: bool,
    /// Whether rays are aimed at the corners of cells and at corners and edges of polygons, in place of
    /// the hemisphere's.
    #[serde(default)]
    pub aimed: bool,
    /// The naive method: a slow twin.
    #[serde(default)]
    pub naive: Option<Twin>,
    /// The naive method: this program under other settings, laid over the experiment.
    #[serde(default)]
    #[schemars(schema_with = "object")]
    pub naive_settings: Overlay,
    /// What is right.
    pub right: Right,
}

/// Fields that go in the place of others.
pub type Overlay = Map<String, Value>;

/// A list of failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Listed {
    /// Failures of which others' figures are known.
    Measured,
    /// Places where such methods fail.
    Places,
    /// Answers that are known, and what must not change them.
    Answers,
}

impl Listed {
    /// All of them, in the page's order.
    pub const ALL: [Listed; 3] = [Listed::Measured, Listed::Places, Listed::Answers];

    /// Its heading.
    pub fn heading(self) -> &'static str {
        match self {
            Listed::Measured => "Failures that others have measured",
            Listed::Places => "Where such methods fail",
            Listed::Answers => "What is known, and what must not matter",
        }
    }
}

fn object(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "type": "object" })
}

/// The schema of a case.
pub fn case_schema() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    Schema::to_value(settings.into_generator().into_root_schema_for::<Case>())
}

impl Case {
    /// Reads a case and checks its own fields; the experiment is read when it is tried.
    ///
    /// # Errors
    /// The first fault met.
    pub fn read(path: &Path) -> Result<(Case, Document), Fault> {
        let document = Document::read(path)?;
        document.refuse_unknown_keys::<Case>()?;
        let case: Case = document.typed(&document.value, |place| place)?;
        let wrong = |field, message: &str| Err(document.fault(&lab::Place::of(field), message));
        if !case.experiment.is_object() {
            return wrong("experiment", "expected an object, the fields of an experiment");
        }
        if case.naive.is_some() && !case.naive_settings.is_empty() {
            return wrong("naive_settings", "expected these or \"naive\", not both");
        }
        if let Some(twin) = case.naive
            && !case.right.asks(twin.measure())
        {
            let message = format!("it shows \"{}\"; expected that in \"right\"", twin.measure());
            return wrong("naive", &message);
        }
        Ok((case, document))
    }
}
