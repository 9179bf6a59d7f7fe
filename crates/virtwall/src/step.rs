//! The steps of the initialisation (§4.2.1).

use multicomputer::StartUp;

/// A step of the initialisation. A machine whose start-up is modelled gives each a price.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A polygon of the scene read from the file's text, and held against the node's environments.
    PolygonRead,
    /// A piece of a polygon cut out for an environment, and entered into cells.
    PolygonCut,
    /// A patch of a quad-tree made.
    PatchMade,
}

impl Step {
    /// Every step.
    pub const ALL: [Step; 3] = [Step::PolygonRead, Step::PolygonCut, Step::PatchMade];

    /// The name by which machine files price it.
    pub fn name(self) -> &'static str {
        match self {
            Step::PolygonRead => "polygon_read",
            Step::PolygonCut => "polygon_cut",
            Step::PatchMade => "patch_made",
        }
    }

    /// The first step that a machine's start-up has no price for.
    pub fn without_price(start_up: &StartUp) -> Option<Step> {
        Step::ALL.into_iter().find(|step| !start_up.cycles.contains_key(step.name()))
    }
}
