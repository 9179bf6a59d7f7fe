//! What a compute node has found when it ends. Plain data: a back end can send it.

use radiosity::Rgb;

use crate::problem::Rank;

/// What a compute node has found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeResult {
    /// Its rank.
    pub rank: Rank,
    /// Shots of its own patches.
    pub local_shots: u64,
    /// Shots of sources that were handed on to it.
    pub received_shots: u64,
    /// Sources handed on, less those shot; over all nodes those still under way or queued.
    pub pending: i64,
    /// Their power, W.
    pub in_transit: Rgb,
    /// Power on virtual walls that was not handed on, W.
    pub on_walls: Rgb,
    /// Its local environments.
    pub environments: Vec<EnvironmentResult>,
}

/// The light in a local environment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EnvironmentResult {
    /// Its number.
    pub environment: u32,
    /// Power absorbed by patches and by backs of polygons, W.
    pub absorbed: Rgb,
    /// Power that left the scene from here, W.
    pub escaped: Rgb,
    /// Power absorbed by participating media, W.
    pub medium: Rgb,
    /// Power that its patches have not shot, W.
    pub unshot: Rgb,
    /// Radiosity by patch, W/m².
    pub radiosity: Vec<Rgb>,
}
