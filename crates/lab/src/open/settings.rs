//! How a scene is meshed, cut and lit: by the experiment's fields, else the scene file's, else automatically.

use radiosity::{HemisphereKind, PatchSize, TooManyPatches};
use serde::Serialize;

use crate::experiment::fields::{Experiment, LEAST_THRESHOLD, is_default};
use crate::experiment::interfaces::{Interfaces, VirtualWalls};
use crate::experiment::refine::RefineFields;
use crate::files::WrongField;
use crate::files::counts::{Pair, Triple};
use crate::open::cut::{automatic_cells, automatic_cut};
use crate::open::scene::Scene;

/// A patch of a bare OBJ file is at most this share of the scene's diagonal long.
const BARE_PATCHES: f64 = 1.0 / 50.0;

/// How a scene is meshed, cut and lit: all that decides the result of a shot. The fields are those of
/// the experiment; lengths are in metres.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    pub scene: String,
    pub cut: Triple,
    pub cells: Triple,
    #[serde(rename = "patch_size_m")]
    pub patch_size: f64,
    #[serde(rename = "emitter_patch_size_m")]
    pub emitter_patch_size: f64,
    #[serde(skip_serializing_if = "RefineFields::is_none")]
    pub refine: RefineFields,
    pub directions: HemisphereKind,
    pub pixels: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_pixels: Option<u32>,
    pub rotated: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub virtual_walls: Option<WallMesh>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mask_bits: Option<u32>,
    #[serde(skip_serializing_if = "is_default")]
    pub by_place: bool,
}

/// A mesh of virtual walls: the part of the settings that decides shots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct WallMesh {
    pub patches: Pair,
    pub directions: u32,
    /// Rays a wall patch.
    pub rays: u32,
}

impl Settings {
    /// The experiment's own settings, else the scene file's, else automatic ones.
    pub fn of(point: &Experiment, scene: &Scene) -> Result<Settings, WrongField> {
        let (cells, cut) = cells_and_cut(point, scene)?;
        let file = scene.file.as_ref();
        let extents = scene.geometry.bounds.size().to_array();
        let diagonal = extents.iter().map(|extent| extent * extent).sum::<f64>().sqrt();
        let own = point.patch_size.as_ref().or(file.map(|file| &file.patch_size));
        let patch_size = own.map_or(diagonal * BARE_PATCHES, |size| size.value());
        let of_file = file.and_then(|file| file.emitter_patch_size.as_ref());
        let emitters = point.emitter_patch_size.as_ref().or(of_file);
        let emitter_patch_size = emitters.map_or(patch_size, |size| size.value());
        let size = PatchSize { reflector: patch_size, emitter: emitter_patch_size };
        size.check(&scene.geometry).map_err(too_many)?;
        Ok(Settings {
            scene: point.scene.clone(),
            cut,
            cells,
            patch_size,
            emitter_patch_size,
            refine: point.refine,
            directions: point.hemisphere.directions,
            pixels: point.hemisphere.pixels,
            least_pixels: point.hemisphere.least_pixels,
            rotated: point.hemisphere.rotated,
            virtual_walls: WallMesh::of(point)?,
            mask_bits: point.mask_bits,
            by_place: point.hemisphere.by_place,
        })
    }
}

/// The field that asks for too many patches.
pub fn too_many(error: TooManyPatches) -> WrongField {
    (if error.emitters { "emitter_patch_size" } else { "patch_size" }, error.to_string())
}

fn cells_and_cut(point: &Experiment, scene: &Scene) -> Result<(Triple, Triple), WrongField> {
    let (file, extents) = (scene.file.as_ref(), scene.geometry.bounds.size().to_array());
    let environments = point.local_environments;
    if let Some(cut) = point.cut.filter(|cut| cut.product() != u64::from(environments)) {
        let message = format!("\"{cut}\" makes {} local environments", cut.product());
        return Err(("cut", format!("{message}; expected {environments}")));
    }
    let chosen = point.cut.or(file.and_then(|file| file.cut(environments)));
    let fixed = point.cells.or(file.and_then(|file| file.cells));
    let Some(cut) = chosen.or_else(|| automatic_cut(extents, environments, fixed)) else {
        let cells = fixed.map_or(String::new(), |cells| format!(" of {cells}"));
        let message = format!("{environments} boxes do not fit the grid of cells{cells}");
        return Err(("local_environments", message + "; expected a cell or more in each"));
    };
    let polygons = scene.geometry.polygons.len();
    let cells = fixed.unwrap_or_else(|| automatic_cells(extents, polygons, cut));
    if (0..3).any(|axis| cut.0[axis] > cells.0[axis]) {
        let message = format!("\"{cut}\" leaves local environments without a cell of {cells}");
        return Err(("cut", message + "; expected at most as many as cells along each axis"));
    }
    Ok((cells, cut))
}

impl WallMesh {
    /// The mesh of an experiment's virtual walls, if it has any.
    pub fn of(point: &Experiment) -> Result<Option<WallMesh>, WrongField> {
        if point.interfaces == Interfaces::Masks {
            return Ok(None);
        }
        let VirtualWalls { patches, directions, rays, threshold } = &point.virtual_walls;
        if threshold.value() < LEAST_THRESHOLD {
            let message = "expected 1e-28 % or more: virtual walls hand on ever less, for ever";
            return Err(("virtual_walls.threshold", format!("{threshold}; {message}")));
        }
        let rays = rays.unwrap_or(point.hemisphere.pixels);
        Ok(Some(WallMesh { patches: *patches, directions: *directions, rays }))
    }
}
