//! The field `hemisphere`: the rays of a source.

use radiosity::HemisphereKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The hemisphere of rays over a source, a ray a pixel. Paper: §3.2.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Hemisphere {
    /// How directions are spread. Choice C1: the paper has a hemisphere of pixels and leaves
    /// their arrangement open; at 30,976 pixels it changes the error of a form factor sixfold.
    pub directions: HemisphereKind,
    /// Pixels, that is rays a source and bits a mask. Choice C1: unpublished; a 4 KB message
    /// (§4.2.3) leaves room for some 32,000, and 30,976 = 176² bits leave 224 bytes for geometry
    /// and photometry.
    #[schemars(range(min = 1))]
    pub pixels: u32,
    /// Pixels of the smallest hemisphere, over the dimmest sources. A source with less unshot energy than
    /// the brightest patch begins with is shot with a quarter of "pixels", a quarter of that and so on,
    /// as long as none of its rays carries more than those of that patch do. Its mask is as short.
    /// Default: all sources have all pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub least_pixels: Option<u32>,
    /// Whether the directions are rotated about the normal by a different angle at each source, so that no
    /// ray runs along a plane systematically.
    pub rotated: bool,
    /// Whether the directions are oriented by the source's position in the scene instead of the axes: a scene
    /// rotated by 90° then has the same light to the last digits.
    pub by_place: bool,
}

impl Default for Hemisphere {
    fn default() -> Hemisphere {
        Hemisphere {
            directions: HemisphereKind::default(),
            pixels: 30_976,
            least_pixels: None,
            rotated: true,
            by_place: true,
        }
    }
}
