//! The kernel with plain records around it, to be watched by valgrind: lights shot a ray at a time from
//! environment to environment, all patches updated and looked at after each shot (§4.2.2, §4.2.3).

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use radiosity::{End, Light, Mask, Ray, Rgb, Side, Source, Work, cast, shoot};
use virtwall::{Parcel, Problem};

/// Table 1's experiment on one processor, with other values set.
///
/// # Errors
/// What is wrong with it.
pub fn plan(set: &[&str]) -> Result<lab::Plan, String> {
    let set: Vec<String> =
        [&["processors=1"], set].concat().into_iter().map(str::to_owned).collect();
    let plan =
        lab::Plan::read(Path::new("experiments/table1.json"), &set, &lab::Preparing::default());
    plan.map_err(|fault| fault.to_string())
}

/// A scene cut into so many environments.
///
/// # Errors
/// What is wrong with the scene.
pub fn problem(scene: &str, environments: u32) -> Result<Arc<Problem>, String> {
    let environments = format!("local_environments={environments}");
    let plan = plan(&[&format!("scene={scene}"), &environments])?;
    Ok(Arc::clone(&plan.problems[0].problem))
}

/// All shots that so many of a scene's lights make, spread evenly over them, one after the other.
pub fn of_lights(problem: &Problem, lights: usize) -> Vec<Parcel> {
    let all = emitters(problem);
    let lights = lights.min(all.len());
    let mut shots = Vec::new();
    for light in 0..lights {
        let mut queue = VecDeque::from([all[light * all.len() / lights].clone()]);
        while let Some(parcel) = queue.pop_front() {
            let environment = &problem.environments[parcel.environment as usize];
            let Parcel { source, mask, .. } = &parcel;
            let shot = shoot(&problem.space, environment, &problem.hemisphere, source, mask);
            queue.extend(problem.onward(&parcel, &shot, 1));
            shots.push(parcel);
        }
    }
    shots
}

/// Every patch that emits, with all its pixels.
fn emitters(problem: &Problem) -> Vec<Parcel> {
    let mut found = Vec::new();
    for (number, environment) in (0..).zip(&problem.environments) {
        let light = Light::new(&problem.space, environment);
        for patch in 0..environment.patches.len() as u32 {
            if light.unshot[patch as usize] != Rgb::ZERO {
                let source = light.source(&problem.space, environment, number, patch);
                let mask = Mask::all(problem.hemisphere.pixels());
                found.push(Parcel {
                    environment: number,
                    source,
                    mask,
                    form_factor: 1.0,
                    through: None,
                });
            }
        }
    }
    found
}

/// A patch as a plain program keeps it: first what a shot reads and writes.
#[derive(Clone)]
pub struct PatchRecord {
    form_factor: f64,
    energy: f64,
    radiosity: Rgb,
    unshot: Rgb,
    reflectance: Rgb,
    area: f64,
    _corners_and_links: [f64; 25],
}

const PATCH: PatchRecord = PatchRecord {
    form_factor: 0.0,
    energy: 0.0,
    radiosity: Rgb::ZERO,
    unshot: Rgb::ZERO,
    reflectance: Rgb::splat(0.5),
    area: 1.0,
    _corners_and_links: [0.0; 25],
};

/// An environment's patches, and the number in it of each polygon of the scene that it has.
pub struct Records {
    patches: Vec<PatchRecord>,
    pieces: Vec<u32>,
}

/// Carry out shots, the first `uncounted` of them for the caches alone.
pub fn carry_out(problem: &Problem, shots: &[Parcel], uncounted: usize) -> f64 {
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let records = problem.environments.iter().map(|environment| Records {
        patches: vec![PATCH; environment.patches.len()],
        pieces: polygons.clone().map(|p| environment.piece(p).unwrap_or(0)).collect(),
    });
    let mut records: Vec<Records> = records.collect();
    let (first, others) = shots.split_at(uncounted);
    for parcel in first {
        shoot_and_update(problem, parcel, &mut records);
    }
    counted(problem, others, &mut records)
}

/// What valgrind counts.
#[inline(never)]
pub fn counted(problem: &Problem, shots: &[Parcel], records: &mut [Records]) -> f64 {
    shots.iter().map(|parcel| shoot_and_update(problem, parcel, records)).sum()
}

/// Shoot a source, make the masks for the neighbours, update all patches, and look for the greatest.
fn shoot_and_update(problem: &Problem, parcel: &Parcel, records: &mut [Records]) -> f64 {
    let Parcel { environment, source, mask, .. } = parcel;
    let Records { patches, pieces } = &mut records[*environment as usize];
    let environment = &problem.environments[*environment as usize];
    let [tangent, bitangent, normal] = problem.hemisphere.frame(source.centre, source.normal);
    let none = |side| environment.has_neighbour(side).then(|| Mask::none(mask.pixels()));
    let mut copies = Side::ALL.map(none);
    let mut work = Work::NONE;
    for pixel in mask.ones() {
        let d = problem.hemisphere.directions[pixel as usize];
        let ray = Ray::new(source.centre, tangent * d.x + bitangent * d.y + normal * d.z);
        match cast(&problem.space, environment, &ray, source.polygon, &mut work) {
            End::Hit { polygon, distance } => {
                let piece = pieces[polygon as usize];
                if let Some(patch) = environment.patch_of(piece, ray.at(distance)) {
                    patches[patch as usize].form_factor += 1.0;
                }
            }
            End::Leaves(side) => {
                copies[side.index()].iter_mut().for_each(|copy| copy.set(pixel));
            }
        }
    }
    std::hint::black_box((&mut copies, work));
    update(patches, source);
    patches.iter().map(|patch| patch.energy).fold(0.0, f64::max)
}

/// All patches, each with its form factor, which is cleared.
fn update(patches: &mut [PatchRecord], source: &Source) {
    for patch in patches {
        let form_factor = std::mem::take(&mut patch.form_factor);
        let arriving = source.power * patch.reflectance * form_factor;
        patch.unshot += arriving;
        patch.radiosity += arriving / patch.area;
        patch.energy += arriving.element_sum();
    }
}
