//! Material files (MTL) of an OBJ file.
//!
//! Read are `newmtl`, `Kd` (reflectance), `Ke` (emitted radiosity, W/m²) and a parameter of our own:
//! `virtwall_two_sided 1` says that both sides of a surface reflect and emit. The rest is ignored.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use tobj::MTLLoadResult;

use super::error::SceneError;
use super::scene::{Material, Rgb};
use super::text::{self, Reader};
use super::warnings::{WarningKind, Warnings};

/// Reflectance of a material that states none (no `Kd`), and of the material that stands in for a
/// missing one.
pub const DEFAULT_REFLECTANCE: Rgb = Rgb::splat(0.5);

/// Our parameter.
const TWO_SIDED: &str = "virtwall_two_sided";

/// The material that stands in for a missing one: grey, dark, one-sided.
pub(crate) fn stand_in() -> Material {
    Material {
        name: "default".to_owned(),
        reflectance: DEFAULT_REFLECTANCE,
        emission: Rgb::ZERO,
        two_sided: false,
    }
}

/// Reads material files as tobj comes upon their names, and keeps what went wrong.
#[derive(Default)]
pub(crate) struct Library {
    read: BTreeSet<PathBuf>,
    pub(crate) warnings: Warnings,
    pub(crate) problem: Option<SceneError>,
}

impl Library {
    /// Reads a file, once. One that cannot be read is a warning; one that makes no sense, a problem.
    pub(crate) fn load(&mut self, path: &Path, reader: Reader) -> MTLLoadResult {
        let nothing = Ok(Default::default());
        if self.problem.is_some() || !self.read.insert(path.to_owned()) {
            return nothing;
        }
        match text::read(path, reader) {
            Ok(text) => match plain(path, &text) {
                Ok(plain) => return tobj::load_mtl_buf(&mut plain.as_bytes()),
                Err(problem) => self.problem = Some(problem),
            },
            Err(error) => self
                .warnings
                .add(WarningKind::MissingMaterialFile, || format!("{}: {error}", path.display())),
        }
        nothing
    }

    /// What tobj read, as a material of ours.
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

/// The lines that matter, checked here because tobj tells no line numbers, ignores most nonsense
/// and panics on a `Kd` of two numbers.
fn plain(path: &Path, text: &str) -> Result<String, SceneError> {
    let mut plain = String::new();
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
                plain += &format!("newmtl {name}\n");
            }
            Some(key @ ("Kd" | "Ke")) => {
                let value = colour(key, &words.collect::<Vec<_>>()).map_err(wrong)?;
                let mut material = Material { name: name.clone(), ..stand_in() };
                match key {
                    "Kd" => material.reflectance = value,
                    _ => material.emission = value,
                }
                material.check().map_err(|error| wrong(error.to_string()))?;
                plain += &format!("{key} {} {} {}\n", value.x, value.y, value.z);
            }
            Some(TWO_SIDED) => match words.next() {
                Some(value @ ("0" | "1")) => plain += &format!("{TWO_SIDED} {value}\n"),
                other => {
                    let value = other.unwrap_or_default();
                    return Err(wrong(format!("{TWO_SIDED} is \"{value}\"; expected 0 or 1")));
                }
            },
            _ => {}
        }
    }
    Ok(plain)
}

/// Three numbers, or one for all three colours.
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
