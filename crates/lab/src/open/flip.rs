//! Faces turned over so that light falls on their fronts.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use config::Fault;
use radiosity::glam::DVec3;
use radiosity::{ObjFile, Scene, turn_faces};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::files::find::{FileKind, find_here};
use crate::open::first_light::{RayEnd, Rays, emits, lamps};
use crate::open::scene::{Read, read, read_file};

/// Points of a lamp that say whether its light meets something.
const POINTS: usize = 4;

/// Paths of light from lamps, for each face.
const PATHS: usize = 64;

/// How often a path is reflected.
const BOUNCES: usize = 16;

/// How often light has to meet a face: rays along edges may err.
const LEAST: u32 = 8;

const SEED: u64 = 1996;

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
    let random = ChaCha8Rng::seed_from_u64(SEED);
    let mut paths = Paths { rays: &rays, random, hits: vec![[0; 2]; count] };
    let all = 0..scene.polygons.len() as u32;
    let lamp = |number: &u32| emits(&scene, &scene.polygons[*number as usize]);
    let away: BTreeSet<u32> =
        all.clone().filter(lamp).filter(|&lamp| paths.shines_away(lamp)).collect();
    for lamp in lamps(&scene, count * PATHS) {
        paths.follow(lamp, !away.contains(&lamp));
    }
    let mut turned: Vec<Option<bool>> = paths.hits.iter().map(|&hits| decide(hits)).collect();
    for polygon in all {
        let face = paths.face(polygon);
        if lamp(&polygon) {
            turned[face] = Some(away.contains(&polygon));
        } else if scene.material_of(polygon).two_sided {
            turned[face] = turned[face].map(|_| false);
        }
    }
    Ok(turned)
}

/// Whether a face is to be turned over by the numbers of rays that met its front and its back.
fn decide([front, back]: [u32; 2]) -> Option<bool> {
    (front + back >= LEAST).then_some(back > front)
}

/// Paths of light, which both sides of all faces reflect.
struct Paths<'a> {
    rays: &'a Rays,
    random: ChaCha8Rng,
    /// For each face, how often light met its front and its back.
    hits: Vec<[u32; 2]>,
}

impl Paths<'_> {
    fn scene(&self) -> &Scene {
        &self.rays.space.scene
    }

    fn face(&self, polygon: u32) -> usize {
        self.scene().polygons[polygon as usize].object as usize
    }

    /// Whether all light from the front of a lamp leaves the scene, but not that from its back.
    fn shines_away(&self, lamp: u32) -> bool {
        let meets = |turned| {
            let mut any = false;
            for point in 0..POINTS {
                let end = |end| any |= matches!(end, RayEnd::Meets { .. });
                self.rays.cast_from(lamp, point, turned, end);
            }
            any
        };
        !meets(false) && meets(true)
    }

    /// Follows light from the front or the back of a lamp.
    fn follow(&mut self, lamp: u32, mut front: bool) {
        let place = [self.random.random::<f64>(), self.random.random::<f64>()];
        let mut polygon = lamp;
        let mut from = self.rays.point(&self.scene().polygons[lamp as usize], place);
        for _ in 0..BOUNCES {
            let normal = self.scene().polygons[polygon as usize].plane.normal;
            let way = self.way(if front { normal } else { -normal });
            let RayEnd::Meets { polygon: met, front: met_front, distance } =
                self.rays.cast(polygon, from, way)
            else {
                return;
            };
            let face = self.face(met);
            self.hits[face][usize::from(!met_front)] += 1;
            (polygon, front) = (met, met_front);
            let plane = self.scene().polygons[met as usize].plane;
            let point = from + way * distance;
            from = point - plane.normal * (plane.normal.dot(point) - plane.offset);
        }
    }

    /// A random direction, cosine-weighted about a normal.
    fn way(&mut self, normal: DVec3) -> DVec3 {
        let (u, v) = normal.any_orthonormal_pair();
        loop {
            let [x, y] = [(); 2].map(|()| 2.0 * self.random.random::<f64>() - 1.0);
            let height = 1.0 - x * x - y * y;
            if height > 0.0 {
                return (u * x + v * y + normal * height.sqrt()).normalize();
            }
        }
    }
}
