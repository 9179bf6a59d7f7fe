//! Changes of materials in a scene description, for materials and objects whose files stay as they are.

use std::collections::BTreeMap;

use config::{Document, Fault, Place, unknown};
use radiosity::{Material, MtlMaterial, ObjFile, Rgb};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What replaces values of the material file.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceFields {
    /// Reflectance: red, green and blue, each from 0 to 1.
    #[serde(rename = "Kd", default, skip_serializing_if = "Option::is_none")]
    pub reflectance: Option<[f64; 3]>,
    /// Emitted radiosity in W/m²: red, green and blue.
    #[serde(rename = "Ke", default, skip_serializing_if = "Option::is_none")]
    pub emission: Option<[f64; 3]>,
    /// Whether both sides reflect and emit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub two_sided: Option<bool>,
}

/// Changes by the name of a material, or of an object.
pub type Surfaces = BTreeMap<String, SurfaceFields>;

impl SurfaceFields {
    /// What is wrong with a value, and its field.
    fn fault(&self, name: &str) -> Option<(&'static str, String)> {
        let grey = Material { name: name.to_owned(), ..Material::default() };
        let wrong = |field, material: Material| Some((field, material.check().err()?.to_string()));
        let reflectance = self.reflectance.map_or(grey.reflectance, Rgb::from);
        let emission = self.emission.map_or(grey.emission, Rgb::from);
        wrong("Kd", Material { reflectance, ..grey.clone() })
            .or_else(|| wrong("Ke", Material { emission, ..grey }))
    }

    fn change(&self, material: &mut MtlMaterial) {
        self.reflectance.iter().for_each(|&rgb| material.set_reflectance(rgb.into()));
        self.emission.iter().for_each(|&rgb| material.set_emission(rgb.into()));
        self.two_sided.iter().for_each(|&both| material.set_two_sided(both));
    }
}

/// Checks the values of a field of a scene description.
pub fn check(document: &Document, field: &str, surfaces: &Surfaces) -> Result<(), Fault> {
    for (name, surface) in surfaces {
        if let Some((part, message)) = surface.fault(name) {
            return Err(document.fault(&Place::of(field).key(name).key(part), message));
        }
    }
    Ok(())
}

/// Changes the materials of these names.
///
/// # Errors
/// A name and a message, if there is no such material.
pub fn change_materials(file: &mut ObjFile, surfaces: &Surfaces) -> Result<(), (String, String)> {
    for (name, surface) in surfaces {
        let known = || file.materials.iter().map(|material| material.name().to_owned());
        if !known().any(|other| other == *name) {
            return Err((name.clone(), unknown("material", name, &known().collect::<Vec<_>>())));
        }
        let named = file.materials.iter_mut().filter(|material| material.name() == name);
        named.for_each(|material| surface.change(material));
    }
    Ok(())
}

/// Gives the objects of these names materials of their own, which are changed.
///
/// # Errors
/// As for materials.
pub fn change_objects(file: &mut ObjFile, surfaces: &Surfaces) -> Result<(), (String, String)> {
    for (name, surface) in surfaces {
        let Some(object) = file.objects.iter().position(|other| other == name) else {
            return Err((name.clone(), unknown("object", name, &file.objects)));
        };
        // The changed copy of each material that the object has.
        let mut copies = BTreeMap::new();
        for face in file.faces.iter_mut().filter(|face| face.object as usize == object) {
            face.material = *copies.entry(face.material).or_insert_with(|| {
                let mut copy = file.materials[face.material as usize].clone();
                surface.change(&mut copy);
                file.materials.push(copy);
                file.materials.len() as u32 - 1
            });
        }
    }
    Ok(())
}
