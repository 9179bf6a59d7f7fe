//! The number of patches that a size of patches makes, counted before any memory is asked for.

use glam::DVec3;

use super::patch::PatchSize;
use super::shape::{Depth, Shape};
use crate::scene::{Rgb, Scene};

/// Most patches of a scene: more would not fit a usual host's memory.
pub const MOST_PATCHES: u64 = 20_000_000;

/// A size of patches that makes too many of them.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "{size} m makes some {patches} patches, up to {} x {} a polygon; expected at most {MOST_PATCHES}",
    along[0], along[1]
)]
pub struct TooManyPatches {
    /// Whether most of them are on polygons that emit.
    pub emitters: bool,
    /// Longest edge of these patches, metres.
    size: f64,
    /// Patches of the scene.
    patches: u64,
    /// The most along the two directions of a polygon.
    along: [u32; 2],
}

impl PatchSize {
    /// Checks that a scene meshed with this size does not have too many patches.
    ///
    /// # Errors
    /// If it has.
    pub fn check(&self, scene: &Scene) -> Result<(), TooManyPatches> {
        self.check_refined(scene, None)
    }

    /// The same with slots halved further as `depth` requires.
    pub(crate) fn check_refined(
        &self,
        scene: &Scene,
        depth: Option<&Depth>,
    ) -> Result<(), TooManyPatches> {
        // By polygons that reflect and that emit.
        let mut counts = [(0, [0; 2]); 2];
        for (id, polygon) in (0..).zip(&scene.polygons) {
            let emits = scene.material(polygon).emission != Rgb::ZERO;
            let size = if emits { self.emitter } else { self.reflector };
            let corners: Vec<DVec3> = scene.corners(polygon).collect();
            let shape = Shape::of_piece(scene, polygon, &corners);
            let (count, most) = &mut counts[usize::from(emits)];
            let product = |[u, v]: [u32; 2]| u64::from(u) * u64::from(v);
            let mut along = shape.slots(size);
            *count += product(along);
            if depth.is_some() && *count <= MOST_PATCHES {
                // All slots are as small as the smallest.
                let deepest = shape.depths(id, size, depth).max().unwrap_or(0);
                *count += product(along) * (4_u64.pow(deepest) - 1);
                along = along.map(|n| n << deepest);
            }
            if product(along) > product(*most) {
                *most = along;
            }
        }
        let patches = counts[0].0 + counts[1].0;
        let emitters = counts[1].0 > counts[0].0;
        let along = counts[usize::from(emitters)].1;
        let size = if emitters { self.emitter } else { self.reflector };
        if patches <= MOST_PATCHES {
            return Ok(());
        }
        Err(TooManyPatches { emitters, size, patches, along })
    }
}
