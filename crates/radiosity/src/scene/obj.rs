//! Wavefront OBJ files. Used are `v`, `f`, `o`, `g`, `usemtl` and `mtllib`; all else is ignored.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::error::{FARTHEST, SceneError};
use super::mtl::{Library, MtlMaterial};
use super::scene::{Face, Scene};
use super::text::{self, Reader, read_regular_file};
use super::warnings::{WarningKind, Warnings};

/// Name of the object of faces before the first `o` or `g`.
const UNNAMED: &str = "unnamed_object";

/// Reads a scene from an OBJ file and its material files, whose paths are relative to the OBJ file.
///
/// A missing material file or an undefined material gives a warning. Such faces are grey
/// ([`DEFAULT_REFLECTANCE`](crate::DEFAULT_REFLECTANCE)), one-sided and do not emit.
///
/// # Errors
/// A file that cannot be read or has invalid content. The message names file, line and value, and
/// states what was expected.
pub fn load_obj(path: &Path) -> Result<(Scene, Warnings), SceneError> {
    load_obj_from(path, &read_regular_file)
}

/// Like [`load_obj`], but reads files through `reader`.
///
/// # Errors
/// As for [`load_obj`].
pub fn load_obj_from(
    path: &Path,
    reader: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
) -> Result<(Scene, Warnings), SceneError> {
    ObjFile::read(path, reader)?.scene()
}

/// The contents of an OBJ file and its material files. They can be changed before they become a
/// scene.
pub struct ObjFile {
    path: PathBuf,
    /// Its faces, with the numbers of their materials and objects.
    pub faces: Vec<Face>,
    /// The materials of its material files, and a grey one if faces have none.
    pub materials: Vec<MtlMaterial>,
    /// Names of objects and groups that have faces. Those of the same name are one object.
    pub objects: Vec<String>,
    /// What was missing or ignored.
    pub warnings: Warnings,
    /// The line of the first vertex with a coordinate that is not finite or too large.
    far_vertex: Option<usize>,
}

impl ObjFile {
    /// Reads an OBJ file and its material files through `reader`.
    ///
    /// # Errors
    /// A file that cannot be read, or has vertices, faces or material names that are invalid.
    pub fn read(path: &Path, reader: Reader) -> Result<ObjFile, SceneError> {
        let text = text::read(path, reader)
            .map_err(|source| SceneError::Unreadable { path: path.to_owned(), source })?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut library = Library::default();
        for statement in statements(&text).filter(|statement| statement.key == "mtllib") {
            library.load(folder, &statement.rest, reader);
        }
        if let Some(error) = library.nameless {
            return Err(error);
        }
        let vertices = Vertices::of(&text).map_err(|error| error.in_file(path))?;
        let Faces { faces, objects, warnings } =
            Faces::of(&text, &library, &vertices.points).map_err(|error| error.in_file(path))?;
        let mut materials = library.materials;
        if warnings.count(WarningKind::MissingMaterial) > 0 {
            materials.push(MtlMaterial::grey());
        }
        let warnings = library.warnings.and(vertices.warnings).and(warnings);
        let (path, far_vertex) = (path.to_owned(), vertices.far);
        Ok(ObjFile { path, faces, materials, objects, warnings, far_vertex })
    }

    /// The materials that faces use.
    pub fn used_materials(&self) -> impl Iterator<Item = &MtlMaterial> {
        let used = self.use_of_materials();
        self.materials.iter().zip(used).filter_map(|(material, used)| used.then_some(material))
    }

    /// Lowers all reflectances in use that are above `most`, but not above 1, with a warning.
    pub fn clamp_reflectances(&mut self, most: f64) {
        for (number, used) in self.use_of_materials().into_iter().enumerate() {
            if used && let Some(change) = self.materials[number].clamp(most) {
                self.warnings.add(WarningKind::Clamped, || change);
            }
        }
    }

    /// The scene of the faces, cleaned, and all warnings.
    ///
    /// # Errors
    /// A material that is used and impossible, or faces that do not make a scene.
    pub fn scene(mut self) -> Result<(Scene, Warnings), SceneError> {
        let used = self.use_of_materials();
        let mut materials = Vec::with_capacity(self.materials.len());
        for (material, used) in self.materials.iter().zip(used) {
            materials.push(if used {
                material.used(&mut self.warnings)?
            } else {
                material.unused()
            });
        }
        let cleaned = Scene::new(&self.faces, materials, self.objects);
        let (scene, warnings) = cleaned.map_err(|error| {
            let line = self.far_vertex.filter(|_| matches!(error, SceneError::Corner { .. }));
            text::wrong(&self.path, line, error.to_string())
        })?;
        Ok((scene, self.warnings.and(warnings)))
    }

    /// Whether each material is that of a face.
    fn use_of_materials(&self) -> Vec<bool> {
        let mut used = vec![false; self.materials.len()];
        for face in &self.faces {
            used[face.material as usize] = true;
        }
        used
    }
}

/// A line that is used. Numbers may go on in the next line, after a backslash.
struct Statement<'a> {
    /// Its line, or its first one, counted from 1.
    line: usize,
    key: &'a str,
    /// Numbers without comments; or a name, perhaps with a comment.
    rest: Cow<'a, str>,
}

fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        loop {
            let (line, found) = lines.next()?;
            let found = found.trim();
            let (key, rest) = found.split_once(char::is_whitespace).unwrap_or((found, ""));
            if ["o", "g", "usemtl", "mtllib"].contains(&key) {
                return Some(Statement { line, key, rest: Cow::Borrowed(rest.trim()) });
            }
            if ["v", "f"].contains(&key) {
                let mut rest = Cow::Borrowed(numbers(rest));
                while let Some(joined) = rest.strip_suffix('\\') {
                    let next = lines.next().map_or("", |(_, next)| numbers(next));
                    rest = Cow::Owned(format!("{joined} {next}"));
                }
                return Some(Statement { line, key, rest });
            }
        }
    })
}

/// Numbers without a comment.
fn numbers(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim_end()
}

/// What is wrong with a line.
struct Problem {
    line: usize,
    problem: String,
}

impl Problem {
    fn of(statement: &Statement, what: &str) -> Problem {
        let found = format!("{} {}", statement.key, statement.rest.trim());
        let found: String = found.trim().chars().take(60).collect();
        Problem { line: statement.line, problem: format!("\"{found}\": {what}") }
    }

    fn in_file(self, path: &Path) -> SceneError {
        text::wrong(path, Some(self.line), self.problem)
    }
}

/// The vertices of a file.
struct Vertices {
    points: Vec<DVec3>,
    warnings: Warnings,
    /// The line of the first one with a coordinate that is not finite or too large.
    far: Option<usize>,
}

impl Vertices {
    /// Vertices of 3 numbers; with a weight 4, with a colour 6, with both 7.
    fn of(text: &str) -> Result<Vertices, Problem> {
        let mut all = Vertices { points: Vec::new(), warnings: Warnings::default(), far: None };
        for statement in statements(text).filter(|statement| statement.key == "v") {
            let expected = "position parse error; expected three numbers: v X Y Z";
            let wrong = || Problem::of(&statement, expected);
            let words: Vec<&str> = statement.rest.split_whitespace().collect();
            let needed = match words.len() {
                count @ (3 | 4) => count,
                6 | 7 => 3,
                _ => return Err(wrong()),
            };
            let numbers: Vec<f64> =
                words[..needed].iter().flat_map(|word| word.parse().ok()).collect();
            let (&[x, y, z] | &[x, y, z, _]) = numbers.as_slice() else { return Err(wrong()) };
            if numbers.len() != needed {
                return Err(wrong());
            }
            if numbers.get(3).is_some_and(|&weight| weight != 1.0) {
                let first = || format!("line {}, {}", statement.line, words[3]);
                all.warnings.add(WarningKind::Weight, first);
            }
            let point = DVec3::new(x, y, z);
            if !point.abs().cmple(DVec3::splat(FARTHEST)).all() {
                all.far.get_or_insert(statement.line);
            }
            all.points.push(point);
        }
        Ok(all)
    }
}

/// The faces of a file.
#[derive(Default)]
struct Faces {
    faces: Vec<Face>,
    objects: Vec<String>,
    warnings: Warnings,
}

impl Faces {
    /// Groups of the same name are one object. Faces without a material get the next number.
    fn of(text: &str, library: &Library, points: &[DVec3]) -> Result<Faces, Problem> {
        let mut all = Faces::default();
        let mut numbers = BTreeMap::new();
        let (mut object, mut material, mut vertices) = (UNNAMED, None, 0);
        let lines: Vec<Statement> = statements(text).collect();
        for statement in &lines {
            match (statement.key, text::name(&statement.rest)) {
                ("v", _) => vertices += 1,
                ("o" | "g", "") => object = UNNAMED,
                ("o" | "g", name) => object = name,
                ("usemtl", _) => material = library.find(&statement.rest),
                ("f", _) => {
                    let number = *numbers.entry(object).or_insert(all.objects.len() as u32);
                    if number as usize == all.objects.len() {
                        all.objects.push(object.to_owned());
                    }
                    let points = corners(statement, points, vertices)?;
                    let of = material.unwrap_or(library.materials.len() as u32);
                    all.faces.push(Face { points, material: of, object: number });
                    if material.is_none() {
                        let place =
                            || format!("object \"{object}\"{}", unknown_material(&lines, library));
                        all.warnings.add(WarningKind::MissingMaterial, place);
                    }
                }
                _ => {}
            }
        }
        Ok(all)
    }
}

/// The corners of a face. Negative numbers count back from the last of the vertices before it.
fn corners(statement: &Statement, points: &[DVec3], before: usize) -> Result<Vec<DVec3>, Problem> {
    let corner = |word: &str| {
        let number = word.split('/').next().unwrap_or_default();
        let expected =
            "face parse error; expected numbers of vertices: f 1 2 3, or f 1/1/1 2/2/2 3/3/3";
        let wanted: i64 = number.parse().map_err(|_| Problem::of(statement, expected))?;
        let from = if wanted < 0 { before as i64 } else { -1 };
        let index = from.checked_add(wanted).and_then(|index| usize::try_from(index).ok());
        index.and_then(|index| points.get(index)).copied().ok_or_else(|| {
            let limit = if wanted < 0 { before } else { points.len() };
            let problem = format!("vertex \"{number}\" of a face; expected 1 to {limit} here");
            Problem { line: statement.line, problem }
        })
    };
    statement.rest.split_whitespace().map(corner).collect()
}

/// The first material that no file defines, as text for a warning.
fn unknown_material(statements: &[Statement], library: &Library) -> String {
    let unknown = statements.iter().filter(|s| s.key == "usemtl").find_map(|statement| {
        let name = text::without_comment(&statement.rest);
        (!name.is_empty() && library.find(&statement.rest).is_none())
            .then_some((statement.line, name))
    });
    unknown.map_or_else(String::new, |(line, name)| {
        format!("; line {line} asks for \"{name}\", which no material file defines")
    })
}
