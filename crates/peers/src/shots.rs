//! The kernel as the paper has it, to be watched by valgrind: lights shot plainly from environment to
//! environment, all patches updated and looked at after each.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;

use radiosity::{Light, Mask, Rgb, Shot, Side, Source, shoot_plainly};
use virtwall::{Parcel, Problem};

/// A scene cut into so many environments, as Figure 11 has it.
///
/// # Errors
/// What is wrong with the scene.
pub fn problem(scene: &str, environments: u32) -> Result<Arc<Problem>, String> {
    let set = ["processors=1", &format!("scene={scene}")].map(str::to_owned);
    let set = [&set[..], &[format!("local_environments={environments}")]].concat();
    let plan = lab::Plan::read(Path::new("experiments/table1.json"), &set);
    let plan = plan.map_err(|fault| fault.to_string())?;
    Ok(Arc::clone(&plan.problems[0].problem))
}

/// Shoot so many of a scene's lights, spread evenly over them, one after the other, and tell `each`
/// of every shot; it says what becomes of the source.
pub fn shoot_lights(problem: &Problem, lights: usize, mut each: impl FnMut(&Parcel) -> Shot) {
    let all = emitters(problem);
    let lights = lights.min(all.len());
    for light in 0..lights {
        let mut queue = VecDeque::from([all[light * all.len() / lights].clone()]);
        while let Some(parcel) = queue.pop_front() {
            let shot = each(&parcel);
            for (side, outgoing) in Side::ALL.into_iter().zip(shot.outgoing) {
                let Some(outgoing) = outgoing else { continue };
                queue.push_back(Parcel {
                    environment: problem.decomposition.neighbour(parcel.environment, side),
                    source: parcel.source,
                    mask: outgoing.mask,
                    form_factor: outgoing.form_factor,
                });
            }
        }
    }
}

/// Every patch that emits, with all its pixels.
fn emitters(problem: &Problem) -> Vec<Parcel> {
    let mut found = Vec::new();
    for (number, environment) in (0..).zip(&problem.environments) {
        let mut light = Light::new(&problem.space, environment);
        for patch in 0..environment.patches.len() as u32 {
            if light.unshot[patch as usize] != Rgb::ZERO {
                let source = light.take_source(&problem.space, environment, number, patch);
                let mask = Mask::all(problem.hemisphere.pixels());
                found.push(Parcel { environment: number, source, mask, form_factor: 1.0 });
            }
        }
    }
    found
}

/// A patch as a plain program keeps it: what an update reads and writes, on 96 bytes.
#[derive(Clone)]
pub struct PatchRecord {
    radiosity: Rgb,
    unshot: Rgb,
    reflectance: Rgb,
    area: f64,
    energy: f64,
    _links: f64,
}

/// Shoot lights natively.
pub fn run(problem: &Problem, lights: usize) -> f64 {
    let record = PatchRecord {
        radiosity: Rgb::ZERO,
        unshot: Rgb::ZERO,
        reflectance: Rgb::splat(0.5),
        area: 1.0,
        energy: 0.0,
        _links: 0.0,
    };
    let environments = problem.environments.iter();
    let mut patches: Vec<_> = environments.map(|e| vec![record.clone(); e.patches.len()]).collect();
    let most = patches.iter().map(Vec::len).max().unwrap_or(0);
    let mut form_factors = vec![0.0; most];
    let mut greatest = 0.0;
    shoot_lights(problem, lights, |parcel| {
        let patches = &mut patches[parcel.environment as usize];
        let (shot, energy) = shoot_and_update(problem, parcel, patches, &mut form_factors);
        greatest = f64::max(greatest, energy);
        shot
    });
    greatest
}

/// What valgrind counts: a source shot, all patches updated, the greatest looked for.
#[inline(never)]
pub fn shoot_and_update(
    problem: &Problem,
    parcel: &Parcel,
    patches: &mut [PatchRecord],
    form_factors: &mut [f64],
) -> (Shot, f64) {
    let Parcel { environment, source, mask, .. } = parcel;
    let environment = &problem.environments[*environment as usize];
    let shot = shoot_plainly(&problem.space, environment, &problem.hemisphere, source, mask);
    for &(patch, form_factor) in &shot.hits {
        form_factors[patch as usize] = form_factor;
    }
    update(patches, form_factors, source);
    let energy = patches.iter().map(|patch| patch.energy).fold(0.0, f64::max);
    (shot, energy)
}

/// All patches, each with its form factor, which is cleared.
fn update(patches: &mut [PatchRecord], form_factors: &mut [f64], source: &Source) {
    for (patch, form_factor) in patches.iter_mut().zip(form_factors) {
        let arriving = source.power * patch.reflectance * std::mem::take(form_factor);
        patch.unshot += arriving;
        patch.radiosity += arriving / patch.area;
        patch.energy += arriving.element_sum();
    }
}
