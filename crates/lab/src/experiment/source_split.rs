//! The field `source_split`: into how many sources a patch is divided.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cutting of patches into several sources.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SplitFields {
    /// Into how many parts a patch is cut along each of its two directions, at most; each shoots with
    /// a hemisphere of its own. 1: patches shoot from their centres, as the paper's do.
    #[schemars(range(min = 1, max = 64))]
    pub most: u32,
    /// Cut a patch only until nothing in front of it is nearer to its centre than this number of edges of
    /// its parts. Default: all patches are cut into "most".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearer_than: Option<f64>,
}

impl Default for SplitFields {
    fn default() -> SplitFields {
        SplitFields { most: 1, nearer_than: None }
    }
}
