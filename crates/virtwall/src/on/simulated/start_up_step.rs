//! The steps of the initialisation.

/// A step of the initialisation (§4.2.1). A machine with a start-up has a price for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartUpStep {
    /// A polygon of the scene read from the file's text and compared with the node's environments.
    PolygonRead,
    /// A piece of a polygon cut out for an environment and entered into cells.
    PolygonCut,
    /// A patch of a quad-tree made.
    PatchMade,
}

impl StartUpStep {
    /// Every step.
    pub const ALL: [StartUpStep; 3] =
        [StartUpStep::PolygonRead, StartUpStep::PolygonCut, StartUpStep::PatchMade];

    /// The name by which machine files price it.
    pub fn name(self) -> &'static str {
        match self {
            StartUpStep::PolygonRead => "polygon_read",
            StartUpStep::PolygonCut => "polygon_cut",
            StartUpStep::PatchMade => "patch_made",
        }
    }
}
