//! The file of a case.

use std::path::Path;

use config::{Document, Fault, Place, schema};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::{Map, Value};

use crate::cases::change::Change;
use crate::cases::expected::Expected;
use crate::cases::naive_method::NaiveMethod;

/// A failure of other methods, and an experiment that shows that it does not happen here.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Virtwall stability case")]
pub struct Case {
    /// Path or URL of the JSON schema, for editors.
    #[serde(rename = "$schema", default)]
    _schema: Option<String>,
    /// The failure in one line.
    pub title: String,
    /// Why careless methods fail.
    pub failure: String,
    /// How this program avoids the failure.
    pub remedy: String,
    /// The list on the page to which the case belongs.
    pub listed: Listed,
    /// An experiment without a title. Paths are relative to the parent folder. Each point of its sweep
    /// is a run of the case.
    #[schemars(schema_with = "object")]
    pub experiment: Value,
    /// Changes to the scene. All runs are repeated on each changed scene.
    #[serde(default)]
    pub changes: Vec<Change>,
    /// Approximate number of rays to cast on the scene of each run; a naive method casts at most
    /// 200,000. Default: the rays of every patch.
    #[serde(default)]
    pub rays: Option<u64>,
    /// Whether only lamps cast rays, instead of all patches.
    #[serde(default)]
    pub lamps_only: bool,
    /// Whether rays are aimed at corners of cells and at corners and edges of polygons, instead of in
    /// the directions of the hemisphere.
    #[serde(default)]
    pub aimed: bool,
    /// The naive method to compare with.
    #[serde(default)]
    pub naive: Option<NaiveMethod>,
    /// Settings that make this program naive: fields that replace those of the experiment.
    #[serde(default)]
    #[schemars(schema_with = "object")]
    pub naive_settings: Overlay,
    /// What is right.
    #[serde(rename = "right")]
    pub expected: Expected,
}

/// Fields that replace those of an experiment.
pub type Overlay = Map<String, Value>;

/// A list on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Listed {
    /// Failures that others have measured.
    Measured,
    /// Situations in which such methods fail.
    Places,
    /// Known answers, and changes that must not affect them.
    Answers,
}

impl Listed {
    /// All lists, in the order of the page.
    pub const ALL: [Listed; 3] = [Listed::Measured, Listed::Places, Listed::Answers];

    /// The heading on the page.
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

/// The JSON schema of a case.
pub fn case_schema() -> Value {
    schema::of::<Case>()
}

impl Case {
    /// Reads a case and checks its own fields. The experiment is checked when its runs are prepared.
    pub fn read(path: &Path) -> Result<(Case, Document), Fault> {
        let document = Document::read(path)?;
        let case: Case = document.read_as()?;
        let wrong = |field, message: &str| Err(document.fault(&Place::of(field), message));
        if !case.experiment.is_object() {
            return wrong("experiment", "expected an object, the fields of an experiment");
        }
        if case.naive.is_some() && !case.naive_settings.is_empty() {
            return wrong("naive_settings", "expected these or \"naive\", not both");
        }
        if let Some(method) = case.naive
            && document.value["right"][method.measure()].is_null()
        {
            let message = format!("it shows \"{}\"; expected that in \"right\"", method.measure());
            return wrong("naive", &message);
        }
        Ok((case, document))
    }
}
