//! Wavefront OBJ files, read with tobj.
//!
//! Used are `v`, `f`, `o`, `g`, `usemtl` and `mtllib`. All other lines are removed before tobj
//! reads the text: it rejects files for errors that do not matter here, such as colours of only
//! some vertices or a wrong index of a texture coordinate.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::{fs, io};

use glam::DVec3;
use tobj::{LoadError, LoadOptions, Model};

use super::error::{FARTHEST, SceneError};
use super::mtl::Library;
use super::scene::{Face, Material, Scene};
use super::text;
use super::warnings::{WarningKind, Warnings};

/// Reads a scene from an OBJ file and its material files, whose paths are relative to the OBJ file.
///
/// A missing material file or an undefined material gives a warning. Such faces are grey
/// ([`DEFAULT_REFLECTANCE`](crate::DEFAULT_REFLECTANCE)), one-sided and do not emit.
///
/// # Errors
/// A file that cannot be read or has invalid content. The message names file, line and value, and
/// states what was expected.
pub fn load_obj(path: &Path) -> Result<(Scene, Warnings), SceneError> {
    load_obj_from(path, &|path| fs::read(path))
}

/// Like [`load_obj`], but reads files through `reader`.
///
/// # Errors
/// As for [`load_obj`].
pub fn load_obj_from(
    path: &Path,
    reader: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
) -> Result<(Scene, Warnings), SceneError> {
    let text = text::read(path, reader)
        .map_err(|source| SceneError::Unreadable { path: path.to_owned(), source })?;
    let text = relevant_lines(&text);
    let folder = path.parent().unwrap_or(Path::new(""));
    let library = RefCell::new(Library::default());

    let mut bytes = Cursor::new(text.as_bytes());
    let loaded = tobj::load_obj_buf(&mut bytes, &LoadOptions::default(), |name| {
        library.borrow_mut().load(&folder.join(name), reader)
    });
    let mut library = library.into_inner();
    if let Some(error) = library.error {
        return Err(error);
    }
    let (models, materials) =
        loaded.map_err(|error| diagnose(path, &text, bytes.position(), error))?;
    let materials = materials.unwrap_or_default();
    let mut materials: Vec<Material> = materials.iter().map(|m| library.material(m)).collect();

    let Faces { faces, objects, warnings } = Faces::of(&models, &materials, &text);
    if warnings.count(WarningKind::MissingMaterial) > 0 {
        materials.push(Material::default());
    }
    let (scene, cleaned) = Scene::new(&faces, materials, objects).map_err(|error| {
        let line = matches!(error, SceneError::Corner { .. }).then(|| far_vertex(&text)).flatten();
        text::wrong(path, line, error.to_string())
    })?;
    Ok((scene, library.warnings.and(warnings).and(cleaned)))
}

/// The lines that are used, without comments. Line numbers do not change.
fn relevant_lines(text: &str) -> String {
    let mut relevant = String::with_capacity(text.len());
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let mut words = line.split_whitespace();
        match words.next() {
            // Three coordinates and a colour, which is removed.
            Some("v") if words.clone().count() == 6 => {
                relevant += "v";
                words.take(3).for_each(|coordinate| relevant.extend([" ", coordinate]));
            }
            Some("v" | "f") => {
                let mut skipped = String::new();
                let mut part = without_comment(line);
                while let Some(joined) = part.strip_suffix('\\') {
                    relevant.extend([joined, " "]);
                    skipped.push('\n');
                    part = without_comment(lines.next().unwrap_or_default());
                }
                relevant.extend([part, &skipped]);
            }
            Some(key @ ("o" | "g" | "usemtl" | "mtllib")) => {
                relevant.extend([key, " ", line.trim_start()[key.len()..].trim()]);
            }
            _ => {}
        }
        relevant.push('\n');
    }
    relevant
}

fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim_end()
}

/// Faces converted from the meshes of tobj.
struct Faces {
    faces: Vec<Face>,
    objects: Vec<String>,
    warnings: Warnings,
}

impl Faces {
    /// Groups of the same name are one object. Faces without a material get the next index.
    fn of(models: &[Model], materials: &[Material], text: &str) -> Faces {
        let mut all =
            Faces { faces: Vec::new(), objects: Vec::new(), warnings: Warnings::default() };
        let mut numbers = BTreeMap::new();
        for Model { name, mesh } in models {
            let object = *numbers.entry(name).or_insert(all.objects.len() as u32);
            if object as usize == all.objects.len() {
                all.objects.push(name.clone());
            }
            let material = mesh.material_id.unwrap_or(materials.len()) as u32;
            let mut indices = mesh.indices.as_slice();
            // tobj gives no numbers of corners if all faces are triangles.
            let triangles = std::iter::repeat_n(3, indices.len() / 3);
            let arities: Vec<u32> = match mesh.face_arities.as_slice() {
                [] => triangles.collect(),
                arities => arities.to_vec(),
            };
            for arity in arities {
                let (corners, rest) = indices.split_at(arity as usize);
                indices = rest;
                let points = corners.iter().map(|&v| vertex(mesh, v)).collect();
                all.faces.push(Face { points, material, object });
                if mesh.material_id.is_none() {
                    all.warnings.add(WarningKind::MissingMaterial, || {
                        format!("object \"{name}\"{}", unknown_material(text, materials))
                    });
                }
            }
        }
        all
    }
}

fn vertex(mesh: &tobj::Mesh, number: u32) -> DVec3 {
    DVec3::from_slice(&mesh.positions[3 * number as usize..])
}

/// The first `usemtl` line whose material no file defines, as text for a warning.
fn unknown_material(text: &str, materials: &[Material]) -> String {
    let unknown = text.lines().enumerate().find_map(|(number, line)| {
        let name = line.strip_prefix("usemtl ")?;
        (!materials.iter().any(|m| m.name == name)).then_some((number + 1, name))
    });
    unknown.map_or_else(String::new, |(line, name)| {
        format!("; line {line} asks for \"{name}\", which no material file defines")
    })
}

/// Turns an error of tobj, which stopped after `read` bytes, into one with line and value.
fn diagnose(path: &Path, text: &str, read: u64, error: LoadError) -> SceneError {
    if error == LoadError::FaceVertexOutOfBounds
        && let Some((line, problem)) = wrong_index(text)
    {
        return text::wrong(path, Some(line), problem);
    }
    let before = &text[..read as usize];
    let (line, found) = (1..).zip(before.lines()).last().unwrap_or_default();
    let expected = match found.split_whitespace().next() {
        Some("v") => "expected three numbers: v X Y Z",
        Some("f") => "expected numbers of vertices: f 1 2 3, or f 1/1/1 2/2/2 3/3/3",
        _ => "expected a name",
    };
    let found: String = found.chars().take(60).collect();
    text::wrong(path, Some(line), format!("\"{found}\": {error}; {expected}"))
}

/// The first face with a vertex that does not exist or, failing that, is defined later.
fn wrong_index(text: &str) -> Option<(usize, String)> {
    let total = text.lines().filter(|line| is_vertex(line)).count() as i64;
    let search = |forward: bool| {
        let mut before = 0;
        text.lines().enumerate().find_map(|(number, line)| {
            before += i64::from(is_vertex(line));
            let limit = if forward { total } else { before };
            let words = line.trim_start().strip_prefix('f')?.split_whitespace();
            let mut vertices = words.map(|word| word.split('/').next().unwrap_or_default());
            let wrong = vertices.find(|word| match word.parse::<i64>() {
                Ok(index) if index < 0 => before.checked_add(index).is_none_or(|v| v < 0),
                Ok(index) => index == 0 || index > limit,
                Err(_) => true,
            })?;
            let problem = format!("vertex \"{wrong}\" of a face; expected 1 to {limit} here");
            Some((number + 1, problem))
        })
    };
    search(true).or_else(|| search(false))
}

/// The line of the first vertex with a coordinate that is not finite or too large.
fn far_vertex(text: &str) -> Option<usize> {
    let far = |line: &str| {
        let mut numbers = line.split_whitespace().skip(1).flat_map(str::parse::<f64>);
        let point = [numbers.next(), numbers.next(), numbers.next()];
        let w = numbers.next().unwrap_or(1.0);
        point.iter().flatten().any(|c| c.is_nan() || (c / w).abs() > FARTHEST)
    };
    text.lines().position(|line| is_vertex(line) && far(line)).map(|index| index + 1)
}

fn is_vertex(line: &str) -> bool {
    line.split_whitespace().next() == Some("v")
}
