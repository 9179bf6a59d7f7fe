//! Faces turned over so that light falls on their fronts.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use config::Fault;
use radiosity::{ObjFile, Scene, turn_faces};

use crate::files::find::{FileKind, find_here};
use crate::open::first_light::{RayEnd, Rays, emits};
use crate::open::scene::{Read, read, read_file};

/// Points of a polygon that light is sent from.
const POINTS: usize = 4;

/// An OBJ file, repaired.
pub struct Flipped {
    /// Its text.
    pub text: String,
    /// The file that it was made from.
    pub of: PathBuf,
    /// Its material files.
    pub materials: Vec<PathBuf>,
    /// How many faces it has.
    pub faces: usize,
    /// How many of them were turned over.
    pub turned: usize,
    /// How many of them no light reached. They stay as they are.
    pub unlit: usize,
    /// The share of the light of the lamps that fell on backs, and that does so now.
    pub backs: [f64; 2],
}

/// Turns the faces of the scene that a name or path means to the side from which more light comes. Lamps stay
/// as they are, unless all of their light leaves the scene.
pub fn flip(name: &str) -> Result<Flipped, Fault> {
    let found = find_here(&FileKind::SCENES, name).map_err(Fault::complete)?;
    let (before, file) = read(&found, &read_file)?;
    if file.as_ref().is_some_and(|file| file.made.is_some()) {
        return Err(Fault::of_file(&found.label, "\"made\"; expected a scene of an OBJ file"));
    }
    let of = before.path.clone();
    let materials = before.others.clone();
    let light = |read: Read, file| Ok::<_, Fault>(read.scene(file)?.first_light);
    let Some(light_before) = light(before, file)? else {
        let message = "no polygon emits light; expected a lamp, since fronts are where light falls";
        return Err(Fault::of_file(&found.label, message));
    };
    let obj = read(&found, &read_file)?.0.obj;
    let faces = obj.faces.len();
    let lit = turned(obj)?;
    let text = read_file(&of).map_err(|error| Fault::of_file(of.display(), error.to_string()))?;
    let text = String::from_utf8_lossy(&text);
    let flags: Vec<bool> = lit.iter().map(|lit| *lit == Some(true)).collect();
    let text = turn_faces(&text, &flags);
    let repaired = |path: &Path| {
        if path == of { Ok(text.clone().into_bytes()) } else { read_file(path) }
    };
    let (after, file) = read(&found, &repaired)?;
    let light_after = light(after, file)?.unwrap_or_default();
    Ok(Flipped {
        of,
        materials,
        faces,
        turned: flags.iter().filter(|&&turned| turned).count(),
        unlit: lit.iter().filter(|lit| lit.is_none()).count(),
        backs: [light_before.backs, light_after.backs],
        text,
    })
}

/// For each face, whether it is to be turned over; none if no light reaches it.
fn turned(mut file: ObjFile) -> Result<Vec<Option<bool>>, Fault> {
    // Each face is an object of its own, so that a polygon tells its face.
    let count = file.faces.len();
    (file.faces.iter_mut().zip(0..)).for_each(|(face, number)| face.object = number);
    file.objects = (0..count).map(|number| number.to_string()).collect();
    let scene = file.scene().map_err(Fault::complete)?.0;
    let Some(rays) = Rays::new(&scene) else { return Ok(vec![None; count]) };
    Ok(Flood::new(&rays, count).all())
}

/// Light on its way from the lamps to ever more faces.
struct Flood<'a> {
    rays: &'a Rays,
    /// For each face, whether it is turned over, once light has reached it.
    turned: Vec<Option<bool>>,
    /// Polygons that light has reached.
    lit: BTreeSet<u32>,
}

impl Flood<'_> {
    fn new(rays: &Rays, faces: usize) -> Flood<'_> {
        Flood { rays, turned: vec![None; faces], lit: BTreeSet::new() }
    }

    fn scene(&self) -> &Scene {
        &self.rays.space.scene
    }

    fn face(&self, polygon: u32) -> usize {
        self.scene().polygons[polygon as usize].object as usize
    }

    fn all(mut self) -> Vec<Option<bool>> {
        let polygons = 0..self.scene().polygons.len() as u32;
        let lamp = |&number: &u32| emits(self.scene(), &self.scene().polygons[number as usize]);
        let mut sources: Vec<u32> = polygons.filter(lamp).collect();
        for &lamp in &sources {
            let wrong = !self.meets(lamp, false) && self.meets(lamp, true);
            let face = self.face(lamp);
            self.turned[face] = Some(wrong);
        }
        self.lit.extend(&sources);
        while !sources.is_empty() {
            sources = self.next(&sources);
        }
        self.turned
    }

    /// Whether light from a polygon meets another one.
    fn meets(&self, polygon: u32, turned: bool) -> bool {
        let mut any = false;
        for point in 0..POINTS {
            let meets = |end| any |= matches!(end, RayEnd::Meets { .. });
            self.rays.cast_from(polygon, point, turned, meets);
        }
        any
    }

    /// Sends light from polygons; returns those that no light had reached before.
    fn next(&mut self, sources: &[u32]) -> Vec<u32> {
        // For each face, how much more light comes from its front than from its back.
        let mut front_less_back = vec![0.0; self.turned.len()];
        let mut reached = BTreeSet::new();
        for &source in sources {
            let turned = self.turned[self.face(source)] == Some(true);
            let power = self.scene().polygons[source as usize].area;
            for point in 0..POINTS {
                self.rays.cast_from(source, point, turned, |end| {
                    if let RayEnd::Meets { polygon, front, .. } = end {
                        front_less_back[self.face(polygon)] += if front { power } else { -power };
                        reached.insert(polygon);
                    }
                });
            }
        }
        let new: Vec<u32> = reached.difference(&self.lit).copied().collect();
        for &polygon in &new {
            let (face, two_sided) = (self.face(polygon), self.is_two_sided(polygon));
            self.turned[face].get_or_insert(front_less_back[face] < 0.0 && !two_sided);
        }
        self.lit.extend(&new);
        new
    }

    fn is_two_sided(&self, polygon: u32) -> bool {
        self.scene().material_of(polygon).two_sided
    }
}
