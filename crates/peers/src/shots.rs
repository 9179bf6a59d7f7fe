//! The kernel with plain records around it, to be watched by valgrind: lights shot a ray at a time from
//! environment to environment, all patches updated and looked at after each shot (§4.2.2, §4.2.3).

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use radiosity::glam::DVec3;
use radiosity::{Bounds, Emitter, End, Light, Mask, Ray, Rgb, Side, Work, cast, shoot};
use virtwall::{Problem, Source};

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
pub fn of_lights(problem: &Problem, lights: usize) -> Vec<Source> {
    let all = emitters(problem);
    let lights = lights.min(all.len());
    let mut shots = Vec::new();
    for light in 0..lights {
        let mut queue = VecDeque::from([all[light * all.len() / lights].clone()]);
        while let Some(parcel) = queue.pop_front() {
            let environment = &problem.environments[parcel.environment as usize];
            let Source { emitter: source, mask, .. } = &parcel;
            let shot = shoot(&problem.space, environment, &problem.hemisphere, source, mask);
            queue.extend(problem.onward(&parcel, &shot));
            shots.push(parcel);
        }
    }
    shots
}

/// Every patch that emits, with all its pixels.
fn emitters(problem: &Problem) -> Vec<Source> {
    let mut found = Vec::new();
    for (number, environment) in (0..).zip(&problem.environments) {
        let light = Light::new(&problem.space, environment);
        for patch in 0..environment.patches.len() as u32 {
            if light.unshot[patch as usize] != Rgb::ZERO {
                let source = light.emitter(&problem.space, environment, number, patch);
                let mask = Mask::all(problem.hemisphere.pixels());
                found.push(Source { environment: number, emitter: source, mask, form_factor: 1.0 });
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
struct Records {
    patches: Vec<PatchRecord>,
    pieces: Vec<u32>,
}

/// What the program keeps: its records, and the masks sent on, which take each other's places.
struct Memory {
    records: Vec<Records>,
    sent: Vec<Vec<u64>>,
    copied: usize,
}

/// A source that waits, and its mask's words.
struct Queued<'a> {
    parcel: &'a Source,
    words: Vec<u64>,
}

/// Carry out shots, the first `uncounted` of them for the caches alone.
pub fn carry_out(problem: &Problem, shots: &[Source], uncounted: usize) -> f64 {
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let records = problem.environments.iter().map(|environment| Records {
        patches: vec![PATCH; environment.patches.len()],
        pieces: polygons.clone().map(|p| environment.piece(p).unwrap_or(0)).collect(),
    });
    let records: Vec<Records> = records.collect();
    let none = Mask::none(problem.hemisphere.pixels()).words().to_vec();
    let mut memory = Memory { sent: vec![none; records.len()], records, copied: 0 };
    let queued = shots.iter().map(|parcel| Queued { parcel, words: parcel.mask.words().to_vec() });
    let mut queued: Vec<Queued<'_>> = queued.collect();
    let (first, others) = queued.split_at_mut(uncounted);
    for source in first {
        shoot_and_update(problem, source, &mut memory);
    }
    counted(problem, others, &mut memory)
}

/// What valgrind counts.
#[inline(never)]
fn counted(problem: &Problem, queued: &mut [Queued<'_>], memory: &mut Memory) -> f64 {
    queued.iter_mut().map(|source| shoot_and_update(problem, source, memory)).sum()
}

/// Shoot a source, make the masks for the neighbours, update all patches, and look for the greatest.
fn shoot_and_update(problem: &Problem, queued: &mut Queued<'_>, memory: &mut Memory) -> f64 {
    let Queued { parcel, words } = queued;
    let Source { environment: number, emitter: source, .. } = parcel;
    let environment = &problem.environments[*number as usize];
    let frame = problem.hemisphere.frame(source.centre, source.normal);
    let Records { patches, pieces } = &mut memory.records[*number as usize];
    let mut work = Work::NONE;
    for (index, word) in words.iter_mut().enumerate() {
        let mut rest = *word;
        while rest != 0 {
            let pixel = index * 64 + rest.trailing_zeros() as usize;
            let ray = ray(problem, source, &frame, pixel);
            let goes_on = match cast(&problem.space, environment, &ray, source.polygon, &mut work) {
                End::Hit { polygon, distance } => {
                    let piece = pieces[polygon as usize];
                    if let Some(patch) = environment.patch_of(piece, ray.at(distance)) {
                        patches[patch as usize].form_factor += 1.0;
                    }
                    false
                }
                End::Leaves(side) => environment.has_neighbour(side),
            };
            if !goes_on {
                *word &= !(1 << (pixel % 64));
            }
            rest &= rest - 1;
        }
    }
    std::hint::black_box(work);
    copy_for_neighbours(problem, queued, &frame, memory);
    let patches = &mut memory.records[*number as usize].patches;
    update(patches, source);
    patches.iter().map(|patch| patch.energy).fold(0.0, f64::max)
}

fn ray(problem: &Problem, source: &Emitter, frame: &[DVec3; 3], pixel: usize) -> Ray {
    let ([tangent, bitangent, normal], d) = (frame, problem.hemisphere.directions[pixel]);
    Ray::new(source.centre, tangent * d.x + bitangent * d.y + normal * d.z)
}

/// For each neighbour a copy of the mask, in which the pixels stay true whose rays hit the plane between.
fn copy_for_neighbours(
    problem: &Problem,
    Queued { parcel, words }: &Queued<'_>,
    frame: &[DVec3; 3],
    memory: &mut Memory,
) {
    let Source { environment, emitter: source, .. } = parcel;
    let environment = &problem.environments[*environment as usize];
    let Bounds { min, max } = problem.space.grid.bounds(&environment.block);
    for side in Side::ALL.into_iter().filter(|&side| environment.has_neighbour(side)) {
        memory.copied += 1;
        let place = memory.copied % memory.sent.len();
        let copy = &mut memory.sent[place];
        copy.copy_from_slice(words);
        let (axis, plane) = (side.axis, if side.upper { max } else { min });
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        for (index, word) in copy.iter_mut().enumerate() {
            let mut rest = *word;
            while rest != 0 {
                let pixel = index * 64 + rest.trailing_zeros() as usize;
                let ray = ray(problem, source, frame, pixel);
                let distance = (plane[axis] - ray.origin[axis]) * ray.inverse[axis];
                let point = ray.at(distance);
                let within = |axis: usize| min[axis] <= point[axis] && point[axis] < max[axis];
                if distance <= 0.0 || !within(b) || !within(c) {
                    *word &= !(1 << (pixel % 64));
                }
                rest &= rest - 1;
            }
        }
    }
}

/// All patches, each with its form factor, which is cleared.
fn update(patches: &mut [PatchRecord], source: &Emitter) {
    for patch in patches {
        let form_factor = std::mem::take(&mut patch.form_factor);
        let arriving = source.power * patch.reflectance * form_factor;
        patch.unshot += arriving;
        patch.radiosity += arriving / patch.area;
        patch.energy += arriving.element_sum();
    }
}
