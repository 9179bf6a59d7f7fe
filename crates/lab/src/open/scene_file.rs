//! A scene description: its geometry and how finely to mesh and to cut it.

use std::collections::BTreeMap;

use config::{Document, Fault, Place, schema};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::experiment::fields::is_default;
use crate::files::counts::Triple;
use crate::files::quantity::Length;
use crate::open::medium::MediumFields;
use crate::open::surface::{self, Surfaces};
use crate::open::unit::Unit;
use crate::open::up::Up;

/// The schema of a scene description.
pub fn scene_schema() -> Value {
    schema::of::<SceneFile>()
}

/// A scene: its geometry, "obj" or "made", and how finely to mesh and to cut it.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Virtwall scene")]
pub struct SceneFile {
    /// Path of this schema, for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What the scene shows, for people.
    #[serde(default)]
    pub title: Option<String>,
    /// The geometry: an OBJ file, relative to this one.
    #[serde(default)]
    pub obj: Option<String>,
    /// Geometry that is generated when the scene is read, in place of a file.
    #[serde(default)]
    pub made: Option<Made>,
    /// What a length of 1 in the OBJ file is: "mm", "cm", "m", "km", "in" or "ft". Default: "m". All other lengths
    /// are in metres.
    #[serde(default, skip_serializing_if = "is_default")]
    pub unit: Unit,
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
    /// The axis that points up in pictures: "x", "-x", "y", "-y", "z" or "-z". Default: "z".
    #[serde(default, skip_serializing_if = "is_default")]
    pub up: Up,
    /// Reflectance, less than 1, to which greater ones are lowered. Default: they stay, but some surface has
    /// to absorb light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clamp_reflectance: Option<f64>,
    /// Whether both sides of all surfaces reflect, but for those that emit, and those of which something else
    /// is said. Default: no.
    #[serde(default, skip_serializing_if = "is_default")]
    pub two_sided: bool,
    /// For a material, by name, values that replace those of the MTL file.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub materials: Surfaces,
    /// For an object, by name, values that replace those of its materials.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub objects: Surfaces,
    /// What absorbs light on its way. Default: nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub media: Vec<MediumFields>,
    /// Where the scene comes from.
    #[serde(default)]
    pub source: Option<String>,
}

/// A building in the manner of the paper's, as `virtwall scene make building` writes it.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Made {
    /// Its floors, five of which are the paper's, with 200 lights on each.
    #[schemars(range(min = 2, max = 1000))]
    pub building_floors: u16,
    /// Seed of what is drawn at random. Default: that of the paper's building.
    #[serde(default = "default_seed")]
    pub seed: u64,
}

fn default_seed() -> u64 {
    1996
}

impl SceneFile {
    /// Reads a scene description and checks it.
    pub fn of(document: &Document) -> Result<SceneFile, Fault> {
        let file: SceneFile = document.read_as()?;
        for (environments, cut) in &file.cuts {
            let place = Place::of("cuts").key(environments);
            if environments.parse() != Ok(cut.product()) {
                let product = cut.product();
                let message = format!("\"{cut}\" makes {product} local environments");
                return Err(document.fault(&place, message + "; expected as many as its key says"));
            }
        }
        for (i, medium) in file.media.iter().enumerate() {
            if let Some(fault) = medium.fault() {
                return Err(document.fault(&Place::of("media").item(i), fault));
            }
        }
        if let Some(most) = file.clamp_reflectance.filter(|most| !(0.0..1.0).contains(most)) {
            let message = format!("{most}; expected 0 or more and less than 1");
            return Err(document.fault(&Place::of("clamp_reflectance"), message));
        }
        surface::check(document, "materials", &file.materials)?;
        surface::check(document, "objects", &file.objects)?;
        if file.made.is_some() && file.unit != Unit::Metre {
            let message = "expected none with \"made\", which is in metres";
            return Err(document.fault(&Place::of("unit"), message));
        }
        if file.obj.is_some() == file.made.is_some() {
            let message = "expected either \"obj\", a file, or \"made\"";
            return Err(document.fault(&Place::default(), message));
        }
        Ok(file)
    }

    /// The cut for a number of local environments, if the file has one.
    pub fn cut(&self, local_environments: u32) -> Option<Triple> {
        self.cuts.get(&local_environments.to_string()).copied()
    }
}
