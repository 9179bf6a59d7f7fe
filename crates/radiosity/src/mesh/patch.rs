//! A patch, and the size of patches.

use glam::DVec3;

/// Largest edge lengths of patches, metres: quad-trees are divided down to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchSize {
    /// On polygons that only reflect.
    pub reflector: f64,
    /// On polygons that emit.
    pub emitter: f64,
}

/// A patch: a surface element with one radiosity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Centroid, where its rays start.
    pub centre: DVec3,
    /// Area in m². Zero if the polygon only touches the environment.
    pub area: f64,
    /// Index of its polygon in the scene.
    pub polygon: u32,
}
