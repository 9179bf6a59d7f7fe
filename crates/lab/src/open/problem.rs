//! Scenes, meshed and cut for the simulator by the settings of an experiment.

use std::sync::Arc;

use radiosity::{DepthBits, Hemisphere, PatchSize, VirtualWalls, VirtualWallsError};
use virtwall::{CutScene, Problem, ProblemError, ProblemOptions};

use crate::files::WrongField;
use crate::host::host_clock::HostClock;
use crate::open::settings::{Settings, WallMesh, too_many};

/// Meshes and cuts a scene.
pub fn problem(scene: &radiosity::Scene, settings: &Settings) -> Result<Arc<Problem>, WrongField> {
    Ok(problem_on(scene, settings, 1)?.0)
}

/// The same on `threads` threads, and the CPU seconds of all of them.
pub fn problem_on(
    scene: &radiosity::Scene,
    settings: &Settings,
    threads: usize,
) -> Result<(Arc<Problem>, f64), WrongField> {
    let clock = HostClock::start();
    let cut = cut(scene, settings)?;
    let cutting_s = clock.cpu_seconds();
    let mesh = |number: usize| {
        let clock = HostClock::start();
        (cut.environment(number as u32), clock.cpu_seconds())
    };
    let meshed = parallel::map(cut.environments() as usize, threads, mesh);
    let (environments, seconds): (_, Vec<f64>) = meshed.into_iter().unzip();
    let cpu_s = cutting_s + seconds.iter().sum::<f64>();
    let problem = cut.with(environments).with_smaller_hemispheres(smaller_hemispheres(settings)?);
    let problem = match settings.mask_bits {
        Some(bits) => problem.with_depth_bits(depth_bits(bits)?),
        None => problem,
    };
    let problem = match settings.virtual_walls {
        Some(mesh) => problem.with_walls(walls(mesh)?),
        None => problem,
    };
    Ok((Arc::new(problem), cpu_s))
}

fn cut(scene: &radiosity::Scene, settings: &Settings) -> Result<CutScene, WrongField> {
    let (reflector, emitter) = (settings.patch_size, settings.emitter_patch_size);
    let options = ProblemOptions {
        patch_size: PatchSize { reflector, emitter },
        cells: settings.cells.0,
        cut: settings.cut.0,
        hemisphere: hemisphere(settings, settings.pixels)?,
    };
    let cut = CutScene::new(scene.clone(), options).map_err(|error| {
        let field = match error {
            ProblemError::Cells(_) => "cells",
            ProblemError::Cut { .. } => "cut",
            ProblemError::PatchSize(..) => "patch_size",
            ProblemError::Patches(error) => return too_many(error),
        };
        (field, error.to_string())
    })?;
    match settings.refine.wanted() {
        Some(wanted) => cut.refined(wanted).map_err(|error| ("refine", error.to_string())),
        None => Ok(cut),
    }
}

/// The hemispheres of dimmer sources, each with a quarter of the pixels of the one before.
fn smaller_hemispheres(settings: &Settings) -> Result<Vec<Hemisphere>, WrongField> {
    let least = settings.least_pixels.unwrap_or(settings.pixels).max(1);
    let smaller = (1..16).map(|quarters| settings.pixels >> (2 * quarters));
    smaller.take_while(|&pixels| pixels >= least).map(|p| hemisphere(settings, p)).collect()
}

fn hemisphere(settings: &Settings, pixels: u32) -> Result<Hemisphere, WrongField> {
    let hemisphere = Hemisphere::new(settings.directions, pixels, settings.rotated)
        .map_err(|error| ("hemisphere.pixels", error.to_string()))?;
    Ok(if settings.by_place { hemisphere } else { hemisphere.by_axes() })
}

fn depth_bits(bits: u32) -> Result<DepthBits, WrongField> {
    DepthBits::of(bits).ok_or_else(|| ("mask_bits", format!("{bits} bits; expected 8 or 16")))
}

fn walls(mesh: WallMesh) -> Result<VirtualWalls, WrongField> {
    VirtualWalls::new(mesh.patches.0, mesh.directions, mesh.rays).map_err(|error| {
        let field = match error {
            VirtualWallsError::Patches(..) => "virtual_walls.patches",
            VirtualWallsError::Directions(_) => "virtual_walls.directions",
            VirtualWallsError::Rays(..) => "virtual_walls.rays",
        };
        (field, error.to_string())
    })
}
