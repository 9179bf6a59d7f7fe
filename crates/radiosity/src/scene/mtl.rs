//! Material files (MTL) of OBJ files.
//!
//! Used are `newmtl`, `Kd` (reflectance), `Ke` (emitted radiosity, W/m²) and an extension:
//! `virtwall_two_sided 1` means that both sides of a surface reflect and emit. Textures and
//! transparency are not modelled: materials that have them give a warning. All else is ignored.
//!
//! They are not read with tobj: it rejects a whole file for one wrong value, does not say on which
//! line it is, and panics if a colour has two numbers.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};

use super::error::{SceneError, values};
use super::scene::{Material, Rgb};
use super::text::{self, Reader, without_comment};
use super::warnings::{WarningKind, Warnings};

/// The extension: name of the parameter.
const TWO_SIDED: &str = "virtwall_two_sided";

/// Most words of a file name in an `mtllib` line that names several files.
const LONGEST_NAME: usize = 16;

/// A material as its file has it. What is wrong with it matters only if a face uses it.
#[derive(Clone, Debug)]
pub struct MtlMaterial {
    /// Its values, not yet checked.
    pub(crate) material: Material,
    /// Ambient colour (`Ka`), which is not used. Above 1 in files that mark lamps in this way.
    pub ambient: Rgb,
    path: PathBuf,
    /// For each keyword with an impossible value, its line and the problem.
    wrong: BTreeMap<&'static str, (usize, String)>,
    has_reflectance: bool,
    /// Whether something says if both sides reflect.
    has_sides: bool,
    /// Statements that are not modelled and change the material, with their kind of warning.
    ignored: BTreeMap<WarningKind, String>,
}

impl MtlMaterial {
    fn new(name: &str, path: &Path) -> MtlMaterial {
        MtlMaterial {
            material: Material { name: name.to_owned(), ..Material::default() },
            ambient: Rgb::ZERO,
            path: path.to_owned(),
            wrong: BTreeMap::new(),
            has_reflectance: false,
            has_sides: false,
            ignored: BTreeMap::new(),
        }
    }

    /// The grey material of faces that have none.
    pub(crate) fn grey() -> MtlMaterial {
        let grey = MtlMaterial::new(&Material::default().name, Path::new(""));
        MtlMaterial { has_reflectance: true, ..grey }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.material.name
    }

    /// Replaces its reflectance, and a texture that would have set it.
    pub fn set_reflectance(&mut self, reflectance: Rgb) {
        self.material.reflectance = reflectance;
        self.has_reflectance = true;
        self.wrong.remove("Kd");
        self.ignored.remove(&WarningKind::Texture);
    }

    /// Replaces its emission, and a texture that would have set it.
    pub fn set_emission(&mut self, emission: Rgb) {
        self.material.emission = emission;
        self.wrong.remove("Ke");
        self.ignored.remove(&WarningKind::EmissionTexture);
    }

    /// Replaces whether both sides reflect and emit.
    pub fn set_two_sided(&mut self, two_sided: bool) {
        self.material.two_sided = two_sided;
        self.has_sides = true;
        self.wrong.remove(TWO_SIDED);
    }

    /// Makes both sides reflect, unless it emits or something else was said.
    pub(crate) fn default_to_two_sided(&mut self) {
        self.material.two_sided |= !self.has_sides && self.material.emission == Rgb::ZERO;
    }

    /// Lowers reflectances of at most 1 to `most`. Returns what changed, for a warning.
    pub(crate) fn clamp(&mut self, most: f64) -> Option<String> {
        let found = self.material.reflectance;
        if !(found.cmple(Rgb::ONE).all() && found.cmpgt(Rgb::splat(most)).any()) {
            return None;
        }
        let taken = found.min(Rgb::splat(most));
        self.set_reflectance(taken);
        Some(format!("\"{}\", Kd {} taken as {}", self.name(), values(found), values(taken)))
    }

    /// The material of faces, and warnings about what is ignored of it.
    ///
    /// # Errors
    /// The first impossible value, with its line.
    pub(crate) fn used(&self, warnings: &mut Warnings) -> Result<Material, SceneError> {
        if let Some((line, problem)) = self.wrong.values().min() {
            return Err(text::wrong(&self.path, Some(*line), problem.clone()));
        }
        let Material { name, reflectance, emission, .. } = &self.material;
        if !self.has_reflectance {
            warnings.add(WarningKind::MissingReflectance, || format!("\"{name}\""));
        }
        for (&kind, statement) in &self.ignored {
            let left = match kind {
                WarningKind::EmissionTexture => format!("its Ke is {}", values(*emission)),
                WarningKind::Transparency => format!("{statement}, Kd {}", values(*reflectance)),
                _ => format!("its Kd is {}", values(*reflectance)),
            };
            warnings.add(kind, || format!("\"{name}\", {left}"));
        }
        Ok(self.material.clone())
    }

    /// The material, which no face uses. Impossible values, which do not matter, are left out.
    pub(crate) fn unused(&self) -> Material {
        let material = self.material.clone();
        if self.wrong.is_empty() {
            return material;
        }
        Material { name: material.name, ..Material::default() }
    }

    /// Reads a statement at a line.
    fn read(&mut self, line: usize, key: &str, rest: &str) {
        let words: Vec<&str> = without_comment(rest).split_whitespace().collect();
        let number = || words.first().and_then(|word| word.parse::<f64>().ok());
        match key {
            "Kd" => {
                self.has_reflectance = true;
                let read = colour("Kd", &words).and_then(|reflectance| {
                    self.material.reflectance = reflectance;
                    self.material.check_reflectance()
                });
                self.note("Kd", line, read);
            }
            "Ke" => {
                let read = colour("Ke", &words).and_then(|emission| {
                    self.material.emission = emission;
                    self.material.check_emission()
                });
                self.note("Ke", line, read);
            }
            TWO_SIDED => {
                let value = words.first().copied().unwrap_or_default();
                self.material.two_sided = value == "1";
                self.has_sides = true;
                let known = ["0", "1"].contains(&value);
                let problem = format!("{TWO_SIDED} is \"{value}\"; expected 0 or 1");
                self.note(TWO_SIDED, line, if known { Ok(()) } else { Err(problem) });
            }
            "Ka" => self.ambient = colour("Ka", &words).unwrap_or_default(),
            "map_Kd" => self.ignore(WarningKind::Texture, rest),
            "map_Ke" => self.ignore(WarningKind::EmissionTexture, rest),
            "map_d" => self.ignore(WarningKind::Transparency, "map_d"),
            // 1 is opaque for "d". Programs disagree whether 0 or 1 is for "Tr" and "Tf".
            "d" if number().is_some_and(|d| d < 1.0) => {
                self.ignore(WarningKind::Transparency, &format!("d {}", words[0]));
            }
            "Tr" if number().is_some_and(|tr| tr > 0.0 && tr < 1.0) => {
                self.ignore(WarningKind::Transparency, &format!("Tr {}", words[0]));
            }
            "Tf" if colour("Tf", &words).is_ok_and(|tf| ![Rgb::ZERO, Rgb::ONE].contains(&tf)) => {
                self.ignore(WarningKind::Transparency, &format!("Tf {}", words.join(" ")));
            }
            _ => {}
        }
    }

    /// Remembers what is wrong with the last value of a keyword, or that nothing is.
    fn note(&mut self, key: &'static str, line: usize, read: Result<(), String>) {
        match read {
            Ok(()) => self.wrong.remove(key),
            Err(problem) => self.wrong.insert(key, (line, problem)),
        };
    }

    fn ignore(&mut self, kind: WarningKind, statement: &str) {
        self.ignored.entry(kind).or_insert_with(|| statement.to_owned());
    }
}

/// Reads a material file by itself, through `reader`: its materials, and what is not modelled of them.
///
/// # Errors
/// A file that cannot be read, a material without a name, or the first impossible value.
pub fn load_mtl(path: &Path, reader: Reader) -> Result<(Vec<Material>, Warnings), SceneError> {
    let mut library = Library::default();
    library
        .load_file(path, reader)
        .map_err(|source| SceneError::Unreadable { path: path.to_owned(), source })?;
    let Library { materials, mut warnings, nameless, .. } = library;
    let used = materials.iter().map(|material| material.used(&mut warnings));
    match nameless {
        Some(error) => Err(error),
        None => Ok((used.collect::<Result<_, _>>()?, warnings)),
    }
}

/// The materials of an OBJ file, from all its material files.
#[derive(Default)]
pub(crate) struct Library {
    read: BTreeSet<PathBuf>,
    pub(crate) materials: Vec<MtlMaterial>,
    /// Number of the last material of each name, as its line has it.
    whole: BTreeMap<String, u32>,
    /// The same with less text: what [`text::name`] or [`without_comment`] leaves.
    shorter: BTreeMap<String, u32>,
    pub(crate) warnings: Warnings,
    /// The first `newmtl` without a name.
    pub(crate) nameless: Option<SceneError>,
}

impl Library {
    /// Reads the files of an `mtllib` line. File names may contain spaces: the longest names that
    /// exist are taken. Files that cannot be read give warnings.
    pub(crate) fn load(&mut self, folder: &Path, names: &str, reader: Reader) {
        if names.is_empty() || self.load_file(&folder.join(names), reader).is_ok() {
            return;
        }
        let words: Vec<&str> = without_comment(names).split_whitespace().collect();
        let (mut rest, mut missing) = (words.as_slice(), Vec::new());
        while let [word, ..] = rest {
            let taken = (1..=rest.len().min(LONGEST_NAME)).rev().find(|&count| {
                self.load_file(&folder.join(rest[..count].join(" ")), reader).is_ok()
            });
            if taken.is_none() {
                missing.push((*word).to_owned());
            }
            rest = &rest[taken.unwrap_or(1)..];
        }
        if missing.len() == words.len() {
            missing = vec![words.join(" ")];
        }
        for path in missing.iter().map(|name| folder.join(name)) {
            if let Err(error) = self.load_file(&path, reader) {
                let problem = || format!("{}: {error}", path.display());
                self.warnings.add(WarningKind::MissingMaterialFile, problem);
            }
        }
    }

    /// Reads a file, once.
    fn load_file(&mut self, path: &Path, reader: Reader) -> io::Result<()> {
        if self.read.contains(path) {
            return Ok(());
        }
        let text = text::read(path, reader)?;
        self.read.insert(path.to_owned());
        let mut material = None;
        for (line, statement) in (1..).zip(text.lines().map(str::trim)) {
            let (key, rest) = statement.split_once(char::is_whitespace).unwrap_or((statement, ""));
            if key == "newmtl" {
                material = self.begin(rest.trim(), path, line);
            } else if let Some(number) = material {
                self.materials[number as usize].read(line, key, rest.trim());
            }
        }
        Ok(())
    }

    /// Begins a material; returns its number.
    fn begin(&mut self, whole: &str, path: &Path, line: usize) -> Option<u32> {
        let name = text::name(whole);
        if name.is_empty() {
            let problem = "newmtl without a name; expected newmtl NAME".to_owned();
            self.nameless.get_or_insert_with(|| text::wrong(path, Some(line), problem));
            return None;
        }
        let number = self.materials.len() as u32;
        self.materials.push(MtlMaterial::new(name, path));
        self.whole.insert(whole.to_owned(), number);
        for shorter in [name, without_comment(whole)] {
            self.shorter.entry(shorter.to_owned()).or_insert(number);
        }
        Some(number)
    }

    /// The number of the material that the rest of a `usemtl` line names: with as much of the text
    /// as there is a material for, since a `#` in it may begin a comment or be part of a name.
    pub(crate) fn find(&self, text: &str) -> Option<u32> {
        let names = [text, text::name(text), without_comment(text)];
        let found =
            |map: &BTreeMap<String, u32>| names.iter().find_map(|&name| map.get(name).copied());
        found(&self.whole).or_else(|| found(&self.shorter))
    }
}

/// A colour: three numbers, or one number for all three components.
fn colour(key: &str, words: &[&str]) -> Result<Rgb, String> {
    let expected = |found: &str| format!("{key} is \"{found}\"; expected numbers: red green blue");
    let numbers: Result<Vec<f64>, String> =
        words.iter().map(|word| word.parse().map_err(|_| expected(word))).collect();
    match numbers?[..] {
        [grey] => Ok(Rgb::splat(grey)),
        [red, green, blue] => Ok(Rgb::new(red, green, blue)),
        _ => Err(expected(&words.join(" "))),
    }
}
