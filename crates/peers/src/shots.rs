//! A native radiosity kernel with plain records, for valgrind: lights are shot one ray at a time from environment
//! to environment; after each shot all patches are updated and searched. Paper: §4.2.2, §4.2.3.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use radiosity::glam::DVec3;
use radiosity::{Bounds, Emitter, End, Light, Mask, Ray, Rgb, Side, Work, cast, shoot};
use virtwall::{Problem, Source};

/// The experiment of Table 1 on one processor, with fields replaced.
pub fn plan(set: &[&str]) -> Result<lab::Plan, String> {
    let set: Vec<String> =
        [&["processors=1"], set].concat().into_iter().map(str::to_owned).collect();
    let plan =
        lab::Plan::read(Path::new("experiments/table1.json"), &set, &lab::Preparing::default());
    plan.map_err(|fault| fault.to_string())
}

/// A scene cut into a number of local environments.
pub fn problem(scene: &str, environments: u32) -> Result<Arc<Problem>, String> {
    let environments = format!("local_environments={environments}");
    let plan = plan(&[&format!("scene={scene}"), &environments])?;
    Ok(Arc::clone(&plan.problems[0].problem))
}

/// All shots of a number of lights, chosen evenly from those of the scene, one light after the other.
pub fn of_lights(problem: &Problem, lights: usize) -> Vec<Source> {
    let all = emitters(problem);
    let lights = lights.min(all.len());
    let mut shots = Vec::new();
    for light in 0..lights {
        let mut queue = VecDeque::from([all[light * all.len() / lights].clone()]);
        while let Some(source) = queue.pop_front() {
            let environment = &problem.environments[source.environment as usize];
            let Source { emitter, mask, .. } = &source;
            let shot = shoot(&problem.space, environment, &problem.hemisphere, emitter, mask);
            queue.extend(problem.onward(&source, &shot));
            shots.push(source);
        }
    }
    shots
}

/// Every patch that emits, with all its pixels set.
fn emitters(problem: &Problem) -> Vec<Source> {
    let mut found = Vec::new();
    for (number, environment) in (0..).zip(&problem.environments) {
        let light = Light::new(&problem.space, environment);
        for patch in 0..environment.patches.len() as u32 {
            if light.unshot[patch as usize] != Rgb::ZERO {
                let emitter = light.emitter(&problem.space, environment, number, patch);
                let mask = Mask::all(problem.hemisphere.pixels());
                found.push(Source {
                    environment: number,
                    shot: 0,
                    emitter,
                    mask,
                    form_factor: 1.0,
                });
            }
        }
    }
    found
}

/// A patch as a plain program stores it. The fields that a shot reads and writes are first.
#[derive(Clone)]
struct PatchRecord {
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

/// The patches of an environment and, by polygon of the scene, its piece in the environment.
struct Records {
    patches: Vec<PatchRecord>,
    pieces: Vec<u32>,
}

/// The memory of the program: its records, and buffers for masks sent to neighbours, which are reused in turn.
struct Memory {
    records: Vec<Records>,
    sent: Vec<Vec<u64>>,
    copied: usize,
}

/// A queued source and the words of its mask.
struct Queued<'a> {
    source: &'a Source,
    words: Vec<u64>,
}

/// Carries out shots. The first `uncounted` ones only fill the caches.
pub fn carry_out(problem: &Problem, shots: &[Source], uncounted: usize) -> f64 {
    let polygons = 0..problem.space.scene.polygons.len() as u32;
    let records = problem.environments.iter().map(|environment| Records {
        patches: vec![PATCH; environment.patches.len()],
        pieces: polygons.clone().map(|p| environment.piece(p).unwrap_or(0)).collect(),
    });
    let records: Vec<Records> = records.collect();
    let none = Mask::none(problem.hemisphere.pixels()).words().to_vec();
    let mut memory = Memory { sent: vec![none; records.len()], records, copied: 0 };
    let queued = shots.iter().map(|source| Queued { source, words: source.mask.words().to_vec() });
    let mut queued: Vec<Queued<'_>> = queued.collect();
    let (first, others) = queued.split_at_mut(uncounted);
    for source in first {
        shoot_and_update(problem, source, &mut memory);
    }
    counted(problem, others, &mut memory)
}

/// The part that valgrind counts; it is found by its name.
#[inline(never)]
fn counted(problem: &Problem, queued: &mut [Queued<'_>], memory: &mut Memory) -> f64 {
    queued.iter_mut().map(|source| shoot_and_update(problem, source, memory)).sum()
}

/// Shoots a source, makes the masks for the neighbours, updates all patches, and finds the greatest energy.
fn shoot_and_update(problem: &Problem, queued: &mut Queued<'_>, memory: &mut Memory) -> f64 {
    let Queued { source, words } = queued;
    let Source { environment: number, emitter, .. } = source;
    let environment = &problem.environments[*number as usize];
    let frame = problem.hemisphere.frame(emitter.centre, emitter.normal);
    let Records { patches, pieces } = &mut memory.records[*number as usize];
    let mut work = Work::NONE;
    for (index, word) in words.iter_mut().enumerate() {
        let mut rest = *word;
        while rest != 0 {
            let pixel = index * 64 + rest.trailing_zeros() as usize;
            let ray = ray(problem, emitter, &frame, pixel);
            let leaves = match cast(&problem.space, environment, &ray, emitter.polygon, &mut work) {
                End::Hit { polygon, distance } => {
                    let piece = pieces[polygon as usize];
                    if let Some(patch) = environment.patch_hit(piece, &ray, distance) {
                        patches[patch as usize].form_factor += 1.0;
                    }
                    false
                }
                End::Leaves(side) => environment.has_neighbour(side),
            };
            if !leaves {
                *word &= !(1 << (pixel % 64));
            }
            rest &= rest - 1;
        }
    }
    std::hint::black_box(work);
    copy_for_neighbours(problem, queued, &frame, memory);
    let patches = &mut memory.records[*number as usize].patches;
    update(patches, emitter);
    patches.iter().map(|patch| patch.energy).fold(0.0, f64::max)
}

fn ray(problem: &Problem, emitter: &Emitter, frame: &[DVec3; 3], pixel: usize) -> Ray {
    let ([tangent, bitangent, normal], d) = (frame, problem.hemisphere.directions[pixel]);
    Ray::new(emitter.centre, tangent * d.x + bitangent * d.y + normal * d.z)
}

/// For each neighbour copies the mask and keeps the pixels whose rays hit the interface.
fn copy_for_neighbours(
    problem: &Problem,
    Queued { source, words }: &Queued<'_>,
    frame: &[DVec3; 3],
    memory: &mut Memory,
) {
    let Source { environment, emitter, .. } = source;
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
                let ray = ray(problem, emitter, frame, pixel);
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

/// Updates all patches by their form factors, which are reset to 0.
fn update(patches: &mut [PatchRecord], emitter: &Emitter) {
    for patch in patches {
        let form_factor = std::mem::take(&mut patch.form_factor);
        let arriving = emitter.power * patch.reflectance * form_factor;
        patch.unshot += arriving;
        patch.radiosity += arriving / patch.area;
        patch.energy += arriving.element_sum();
    }
}
