//! The blocks that all runs of a problem share: its patches, and what each shot hits.

use std::collections::BTreeMap;

use radiosity::{Bounds, Mesh, Rgb, Shading};
use virtwall::{Problem, ShotKey};

use crate::columns::Columns;
use crate::film::{Beam, Film};

/// Steps that the scene's length is told in, along each axis.
const STEPS: f64 = 65_535.0;

/// Materials, boxes, patches with their corners.
pub(crate) fn geometry(problem: &Problem) -> Columns {
    let mut columns = Columns::default();
    let scene = &problem.space.scene;
    let (low, high) = (scene.bounds.min, scene.bounds.max);
    columns.floats([low, high].iter().flat_map(|corner| corner.to_array()));
    let boxes = problem.environments.iter().map(|e| problem.space.grid.bounds(&e.block));
    columns.floats(boxes.flat_map(|b| b.min.to_array().into_iter().chain(b.max.to_array())));
    let materials = scene.materials.iter().flat_map(|m| [m.reflectance, m.emission]);
    columns.floats(materials.flat_map(|rgb: Rgb| rgb.to_array()));
    columns.ints(scene.polygons.iter().map(|polygon| u64::from(polygon.material)));
    let patches = || problem.environments.iter().flat_map(|e| e.patches.iter());
    columns.ints(problem.environments.iter().map(|e| e.patches.len() as u64));
    columns.steps(patches().map(|patch| i64::from(patch.polygon)));
    corners(problem, &mut columns);
    let areas = problem.environments.iter();
    columns.floats(
        areas.flat_map(|e| (0..e.patches.len() as u32).map(|patch| e.radiosity_area(patch))),
    );
    columns
}

/// Where corners of patches are, each place once for those that smooth shading takes together, and the
/// corners of each patch.
fn corners(problem: &Problem, columns: &mut Columns) {
    let mesh = Mesh::new(&problem.space, &problem.environments, Shading::Smooth);
    let Bounds { min: low, max: high } = problem.space.scene.bounds;
    // Numbered in the order in which patches have them.
    let mut numbers = vec![None; mesh.positions().len()];
    let mut places = Vec::new();
    let corners = || mesh.fans().map(|fan| fan.get(1..).unwrap_or_default());
    columns.ints(corners().map(|corners| corners.len() as u64));
    columns.steps(corners().flatten().map(|&vertex| {
        *numbers[vertex as usize].get_or_insert_with(|| {
            places.push(mesh.positions()[vertex as usize]);
            places.len() as i64 - 1
        })
    }));
    for axis in 0..3 {
        let per_metre = STEPS / (high[axis] - low[axis]).max(f64::MIN_POSITIVE);
        let coded = places.iter().map(|p| ((p[axis] - low[axis]) * per_metre).round());
        columns.steps(coded.map(|step| step.clamp(0.0, STEPS) as i64));
    }
}

/// Shots of several runs, each different one once.
pub(crate) struct Shots<'a> {
    numbers: BTreeMap<ShotKey, u64>,
    beams: Vec<&'a Beam>,
}

impl<'a> Shots<'a> {
    /// Those of all films, numbered in the order of the films, nodes and times.
    pub fn of(films: impl Iterator<Item = &'a Film>) -> Shots<'a> {
        let mut shots = Shots { numbers: BTreeMap::new(), beams: Vec::new() };
        for beam in films.flat_map(|film| film.beams.iter().flatten()) {
            let number = shots.beams.len() as u64;
            if *shots.numbers.entry(beam.key).or_insert(number) == number {
                shots.beams.push(beam);
            }
        }
        shots
    }

    /// The number of a shot.
    pub fn number(&self, beam: &Beam) -> u64 {
        self.numbers.get(&beam.key).copied().unwrap_or_default()
    }

    /// All of them as columns; form factors count in pixels, or 256ths of them where pixels differ or
    /// media dim them.
    pub fn columns(&self, problem: &Problem) -> Columns {
        let pixels = f64::from(problem.hemisphere.pixels());
        let whole = |hit: &(u32, f32)| {
            let count = f64::from(hit.1) * pixels;
            (count - count.round()).abs() < 0.01
        };
        let all_whole = self.beams.iter().flat_map(|beam| &beam.hits).all(whole);
        let unit = if all_whole { 1.0 / pixels } else { fine_unit(problem) };
        let mut columns = Columns::default();
        beam_columns(&self.beams, unit, &mut columns);
        columns
    }
}

/// The form factor that counts one where pixels differ.
pub(crate) fn fine_unit(problem: &Problem) -> f64 {
    1.0 / f64::from(problem.hemisphere.pixels()) / 256.0
}

/// What shots hit, with form factors in multiples of `unit`.
pub(crate) fn beam_columns(shots: &[&Beam], unit: f64, columns: &mut Columns) {
    let beams = || shots.iter();
    let units = |form_factor: f64| (form_factor / unit).round() as u64;
    columns.floats([unit]);
    columns.ints(beams().map(|beam| u64::from(beam.environment)));
    columns.ints(beams().map(|beam| beam.hits.len() as u64));
    columns.ints(beams().flat_map(|beam| {
        let last = [0].into_iter().chain(beam.hits.iter().map(|hit| hit.0));
        beam.hits.iter().zip(last).map(|(hit, last)| u64::from(hit.0 - last))
    }));
    columns.ints(beams().flat_map(|beam| beam.hits.iter().map(|hit| units(f64::from(hit.1)))));
    columns.ints(beams().map(|beam| units(beam.backs)));
    columns.ints(beams().map(|beam| units(beam.escaped)));
    columns.ints(beams().map(|beam| units(beam.medium)));
    columns.ints(beams().map(|beam| units(beam.outgoing)));
}
