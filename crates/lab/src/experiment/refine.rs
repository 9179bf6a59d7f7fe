//! The field "refine" of an experiment: smaller patches where radiosity changes.

use radiosity::Wanted;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Greatest number of times that an edge may be halved.
pub const MOST_HALVINGS: u32 = 6;

/// Smaller patches where radiosity changes, and nowhere else. A pilot run finds out where that is, before
/// the run proper and beside its time: the column pilot_rays says what it cast.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RefineFields {
    /// The error that a radiosity a patch may leave of itself, as a root mean square by area over that of
    /// what is reflected. Patches of "patch_size" are halved along both edges, again and again, where that
    /// spares most, until by the pilot's estimate it is no more than this. Choice C44. Default: none is
    /// halved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_l2: Option<f64>,
    /// How often edges are halved, at most.
    #[schemars(range(min = 1, max = 6))]
    pub most_halvings: u32,
}

impl Default for RefineFields {
    fn default() -> RefineFields {
        RefineFields { relative_l2: None, most_halvings: 3 }
    }
}

impl RefineFields {
    /// Whether patches are left as they are.
    pub fn is_none(&self) -> bool {
        self.relative_l2.is_none()
    }

    /// The refinement that the experiment asks for, if any.
    pub fn wanted(&self) -> Option<Wanted> {
        let RefineFields { relative_l2, most_halvings } = *self;
        relative_l2.map(|relative_l2| Wanted { relative_l2, most_halvings })
    }
}
