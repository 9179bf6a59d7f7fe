//! Wavefront OBJ files. Used are `v`, `f`, `o`, `g`, `usemtl` and `mtllib`; all else is ignored.
//!
//! tobj parses the vertices and faces. It gets them without comments, weights, colours and texture
//! coordinates: it rejects files for errors in these, and divides coordinates by weights. Names are
//! resolved here, since tobj keeps the comments in them and rejects empty ones.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};

use glam::DVec3;
use tobj::{LoadError, LoadOptions, Mesh};

use super::error::{FARTHEST, SceneError};
use super::mtl::{Library, MtlMaterial};
use super::scene::{Face, Scene};
use super::text::{self, Reader, numbers, read_regular_file};
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
        let statements: Vec<Statement> = statements(&text).collect();
        for statement in statements.iter().filter(|statement| statement.key == "mtllib") {
            library.load(folder, &statement.rest, reader);
        }
        if let Some(error) = library.nameless {
            return Err(error);
        }
        let corners = corners(&statements).map_err(|error| error.in_file(path))?;
        let far_vertex = far_vertex(&statements, &corners);
        let Faces { faces, objects, warnings } = Faces::of(&statements, &library, corners);
        let mut materials = library.materials;
        if warnings.count(WarningKind::MissingMaterial) > 0 {
            materials.push(MtlMaterial::grey());
        }
        let warnings = library.warnings.and(warnings);
        Ok(ObjFile { path: path.to_owned(), faces, materials, objects, warnings, far_vertex })
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

    /// Multiplies all coordinates.
    pub fn scale(&mut self, factor: f64) {
        let faces = self.faces.iter_mut();
        faces.flat_map(|face| &mut face.points).for_each(|point| *point *= factor);
    }

    /// Makes both sides of all materials reflect that do not emit, and of which nothing else is said.
    pub fn default_to_two_sided(&mut self) {
        self.materials.iter_mut().for_each(MtlMaterial::default_to_two_sided);
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

impl Statement<'_> {
    /// The weight of a vertex of four numbers, and the word that it is.
    fn weight(&self) -> Option<(f64, &str)> {
        let words: Vec<&str> = self.rest.split_whitespace().collect();
        let &[_, _, _, word] = words.as_slice() else { return None };
        word.parse().ok().filter(|_| self.key == "v").map(|weight| (weight, word))
    }

    /// A line for tobj, empty without geometry. Vertices have 3 numbers; with a weight 4, with a
    /// colour 6, with both 7: the first 3 stay. Wrong vertices stay as they are.
    fn geometry(&self) -> String {
        let words = self.rest.split_whitespace();
        let words: Vec<&str> = match (self.key, words.clone().count()) {
            ("v", 6 | 7) => words.take(3).collect(),
            ("v", 4) if self.weight().is_some() => words.take(3).collect(),
            ("v", _) => words.collect(),
            // The slash keeps a corner without a number, which is an error.
            ("f", _) => words.flat_map(|word| word.split_inclusive('/').next()).collect(),
            _ => return "\n".to_owned(),
        };
        format!("{} {}\n", self.key, words.join(" "))
    }
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

/// What is wrong with a line.
struct Problem {
    line: usize,
    problem: String,
}

impl Problem {
    /// A vertex or a face that cannot be parsed.
    fn of(statement: &Statement) -> Problem {
        let what = match statement.key {
            "v" => "position parse error; expected three numbers: v X Y Z",
            _ => "face parse error; expected numbers of vertices: f 1 2 3, or f 1/1/1 2/2/2 3/3/3",
        };
        let found = format!("{} {}", statement.key, statement.rest.trim());
        let found: String = found.trim().chars().take(60).collect();
        Problem { line: statement.line, problem: format!("\"{found}\": {what}") }
    }

    fn in_file(self, path: &Path) -> SceneError {
        text::wrong(path, Some(self.line), self.problem)
    }
}

/// The corners of each face, in the order of the file.
///
/// tobj does not get objects and materials: it would refuse vertices after the end of the object
/// that uses them.
fn corners(statements: &[Statement]) -> Result<Vec<Vec<DVec3>>, Problem> {
    let text: String = statements.iter().map(Statement::geometry).collect();
    let mut bytes = Cursor::new(text.as_bytes());
    let none = |_: &Path| Ok(Default::default());
    let loaded = tobj::load_obj_buf(&mut bytes, &LoadOptions::default(), none);
    let (models, _) = loaded.map_err(|error| {
        let read = text[..bytes.position() as usize].lines().count();
        let wrong = (error == LoadError::FaceVertexOutOfBounds).then(|| wrong_corner(statements));
        wrong.flatten().unwrap_or_else(|| Problem::of(&statements[read - 1]))
    })?;
    Ok(models.iter().flat_map(|model| corners_of(&model.mesh)).collect())
}

fn corners_of(mesh: &Mesh) -> impl Iterator<Item = Vec<DVec3>> {
    let mut indices = mesh.indices.iter();
    // tobj gives no numbers of corners if all faces are triangles.
    let triangles = if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { 0 };
    let counts = mesh.face_arities.iter().copied().chain(std::iter::repeat_n(3, triangles));
    counts.map(move |count| {
        let corners = indices.by_ref().take(count as usize);
        corners.map(|&v| DVec3::from_slice(&mesh.positions[3 * v as usize..])).collect()
    })
}

/// The first corner without a number or without a vertex: tobj reports no line of it. Negative
/// numbers count back from the last of the vertices before the face.
fn wrong_corner(statements: &[Statement]) -> Option<Problem> {
    let total = statements.iter().filter(|statement| statement.key == "v").count() as i64;
    let mut before = 0;
    statements.iter().find_map(|statement| {
        before += i64::from(statement.key == "v");
        let mut words = statement.rest.split_whitespace().filter(|_| statement.key == "f");
        words.find_map(|word| {
            let number = word.split('/').next().unwrap_or_default();
            let Ok(wanted) = number.parse::<i64>() else { return Some(Problem::of(statement)) };
            let limit = if wanted < 0 { before } else { total };
            if (1..=limit).contains(&wanted.saturating_abs()) {
                return None;
            }
            let problem = format!("vertex \"{number}\" of a face; expected 1 to {limit} here");
            Some(Problem { line: statement.line, problem })
        })
    })
}

/// The line of the first vertex with a coordinate that is not finite or too large, if a face has
/// such a corner.
fn far_vertex(statements: &[Statement], corners: &[Vec<DVec3>]) -> Option<usize> {
    let far = |point: DVec3| !point.abs().cmple(DVec3::splat(FARTHEST)).all();
    if !corners.iter().flatten().any(|&corner| far(corner)) {
        return None;
    }
    let first = statements.iter().filter(|statement| statement.key == "v").find(|vertex| {
        let mut numbers = vertex.rest.split_whitespace().take(3).flat_map(str::parse);
        numbers.any(|number| far(DVec3::splat(number)))
    });
    first.map(|vertex| vertex.line)
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
    fn of(statements: &[Statement], library: &Library, corners: Vec<Vec<DVec3>>) -> Faces {
        let mut all = Faces::default();
        let mut numbers = BTreeMap::new();
        let mut corners = corners.into_iter();
        let (mut object, mut material) = (UNNAMED, None);
        for statement in statements {
            match (statement.key, text::name(&statement.rest)) {
                ("v", _) => {
                    if let Some((weight, word)) = statement.weight()
                        && weight != 1.0
                    {
                        let first = || format!("line {}, {word}", statement.line);
                        all.warnings.add(WarningKind::Weight, first);
                    }
                }
                ("o" | "g", "") => object = UNNAMED,
                ("o" | "g", name) => object = name,
                ("usemtl", _) => material = library.find(&statement.rest),
                ("f", _) => {
                    let number = *numbers.entry(object).or_insert(all.objects.len() as u32);
                    if number as usize == all.objects.len() {
                        all.objects.push(object.to_owned());
                    }
                    let points = corners.next().unwrap_or_default();
                    let of = material.unwrap_or(library.materials.len() as u32);
                    all.faces.push(Face { points, material: of, object: number });
                    if material.is_none() {
                        all.warnings.add(WarningKind::MissingMaterial, || {
                            format!("object \"{object}\"{}", unknown_material(statements, library))
                        });
                    }
                }
                _ => {}
            }
        }
        all
    }
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
