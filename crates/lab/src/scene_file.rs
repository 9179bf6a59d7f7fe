//! A scene description: an OBJ file and how finely to mesh and to cut it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::document::Document;
use crate::fault::Fault;
use crate::place::Place;
use crate::quantity::{Length, Triple};
use crate::schema;

/// The schema of a scene description.
pub fn scene_schema() -> Value {
    schema::of::<SceneFile>()
}

/// A scene: an OBJ file and how finely to mesh and to cut it.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Virtwall scene")]
pub struct SceneFile {
    /// Where this schema lies, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What the scene shows, for people.
    #[serde(default)]
    pub title: Option<String>,
    /// The geometry: an OBJ file, relative to this one.
    pub obj: String,
    /// Longest edge of a patch, such as "0.30 m".
    pub patch_size: Length,
    /// Longest edge of a patch that emits light. Default: as "patch_size".
    #[serde(default)]
    pub emitter_patch_size: Option<Length>,
    /// Cells along x, y and z, such as "56x28x14". Default: about one cell a polygon.
    #[serde(default)]
    pub cells: Option<Triple>,
    /// For a number of local environments, how many there are along x, y and z.
    #[serde(default)]
    pub cuts: BTreeMap<String, Triple>,
    /// Where the scene comes from.
    #[serde(default)]
    pub source: Option<String>,
}

impl SceneFile {
    /// Reads a scene description and checks it.
    ///
    /// # Errors
    /// A fault of the document, at its place.
    pub fn of(document: &Document) -> Result<SceneFile, Fault> {
        document.refuse_unknown_keys::<SceneFile>()?;
        let file: SceneFile = document.typed(&document.value, |place| place)?;
        for (environments, cut) in &file.cuts {
            let place = Place::of("cuts").key(environments);
            if environments.parse() != Ok(cut.product()) {
                let product = cut.product();
                let message = format!("\"{cut}\" makes {product} local environments");
                return Err(document.fault(&place, message + "; expected as many as its key says"));
            }
        }
        Ok(file)
    }

    /// The cut for a number of local environments, if the file has one.
    pub fn cut(&self, local_environments: u32) -> Option<Triple> {
        self.cuts.get(&local_environments.to_string()).copied()
    }
}
