//! Material files (MTL) of OBJ files, read with tobj.
//!
//! Used are `newmtl`, `Kd` (reflectance), `Ke` (emitted radiosity, W/m²) and an extension:
//! `virtwall_two_sided 1` means that both sides of a surface reflect and emit. All else is ignored.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use tobj::MTLLoadResult;

use super::error::SceneError;
use super::scene::{DEFAULT_REFLECTANCE, Material, Rgb};
use super::text::{self, Reader};
use super::warnings::{WarningKind, Warnings};

/// The extension: name of the parameter.
const TWO_SIDED: &str = "virtwall_two_sided";

/// Reads material files when tobj finds their names, and collects warnings and the first error.
#[derive(Default)]
pub(crate) struct Library {
    read: BTreeSet<PathBuf>,
    pub(crate) warnings: Warnings,
    pub(crate) error: Option<SceneError>,
}

impl Library {
    /// Reads a file once. An unreadable file gives a warning, invalid content an error.
    pub(crate) fn load(&mut self, path: &Path, reader: Reader) -> MTLLoadResult {
        let nothing = Ok(Default::default());
        if self.error.is_some() || !self.read.insert(path.to_owned()) {
            return nothing;
        }
        match text::read(path, reader) {
            Ok(text) => match relevant_lines(path, &text) {
                Ok(relevant) => return tobj::load_mtl_buf(&mut relevant.as_bytes()),
                Err(error) => self.error = Some(error),
            },
            Err(error) => self
                .warnings
                .add(WarningKind::MissingMaterialFile, || format!("{}: {error}", path.display())),
        }
        nothing
    }

    /// Converts a material of tobj.
    pub(crate) fn material(&mut self, read: &tobj::Material) -> Material {
        if read.diffuse.is_none() {
            self.warnings.add(WarningKind::MissingReflectance, || format!("\"{}\"", read.name));
        }
        Material {
            name: read.name.clone(),
            reflectance: read.diffuse.map_or(DEFAULT_REFLECTANCE, Rgb::from),
            emission: read.emissive.map_or(Rgb::ZERO, Rgb::from),
            two_sided: read.unknown_param.get(TWO_SIDED).is_some_and(|value| value == "1"),
        }
    }
}

/// The lines that are used, checked: tobj reports no line numbers, ignores most invalid values and
/// panics on a `Kd` with two numbers.
fn relevant_lines(path: &Path, text: &str) -> Result<String, SceneError> {
    let mut relevant = String::new();
    let mut name = String::new();
    for (number, line) in text.lines().enumerate() {
        let wrong = |problem: String| text::wrong(path, Some(number + 1), problem);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("newmtl") => {
                name = line.trim()["newmtl".len()..].trim().to_owned();
                if name.is_empty() {
                    return Err(wrong("newmtl without a name; expected newmtl NAME".to_owned()));
                }
                relevant += &format!("newmtl {name}\n");
            }
            Some(key @ ("Kd" | "Ke")) => {
                let value = colour(key, &words.collect::<Vec<_>>()).map_err(wrong)?;
                let mut material = Material { name: name.clone(), ..Material::default() };
                match key {
                    "Kd" => material.reflectance = value,
                    _ => material.emission = value,
                }
                material.check().map_err(|error| wrong(error.to_string()))?;
                relevant += &format!("{key} {} {} {}\n", value.x, value.y, value.z);
            }
            Some(TWO_SIDED) => match words.next() {
                Some(value @ ("0" | "1")) => relevant += &format!("{TWO_SIDED} {value}\n"),
                other => {
                    let value = other.unwrap_or_default();
                    return Err(wrong(format!("{TWO_SIDED} is \"{value}\"; expected 0 or 1")));
                }
            },
            _ => {}
        }
    }
    Ok(relevant)
}

/// A colour: three numbers, or one number for all three components.
fn colour(key: &str, words: &[&str]) -> Result<Rgb, String> {
    let expected = |found: &str| format!("{key} is \"{found}\"; expected numbers: red green blue");
    let words: Vec<&str> = words.iter().copied().take_while(|w| !w.starts_with('#')).collect();
    let numbers: Result<Vec<f64>, String> =
        words.iter().map(|word| word.parse().map_err(|_| expected(word))).collect();
    match numbers?[..] {
        [grey] => Ok(Rgb::splat(grey)),
        [red, green, blue] => Ok(Rgb::new(red, green, blue)),
        _ => Err(expected(&words.join(" "))),
    }
}
