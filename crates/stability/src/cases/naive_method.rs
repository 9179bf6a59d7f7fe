//! Names of naive methods.

use schemars::JsonSchema;
use serde::Deserialize;

/// The most rays that a naive method casts, since most of these methods are slow.
pub const MAX_RAYS: u64 = 200_000;

/// A naive method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NaiveMethod {
    /// Triangles in single precision and world coordinates, with the test of Möller and Trumbore.
    SingleTriangles,
    /// The same, but each polygon stores its first corner and its edges in single precision, so that
    /// shared corners of neighbours differ.
    UnweldedTriangles,
    /// Triangles in single precision; of several at equal distance the last one is hit.
    SingleDistances,
    /// Polygons as in the file, assumed to be planar and convex.
    TrustedFaces,
    /// Normals of polygons as in the file, divided by a length that may be zero.
    TrustedNormals,
    /// A ray enters every neighbour whose interface it meets, edges included.
    ClosedFaces,
    /// A ray enters every neighbour whose interface it meets, edges excluded.
    OpenFaces,
    /// A ray enters every neighbour whose plane it meets, even outside the interface.
    UnboundedPlanes,
    /// A grid walk that accumulates distances and divides by components that may be zero.
    AddedSteps,
    /// Hits closer than a millimetre are ignored.
    Millimetre,
    /// Radiosity is deposited instead of energy, also on very small patches.
    DepositedRadiosity,
    /// Energy summed ray by ray in single precision.
    SingleSums,
    /// A radiosity solution with the leaks of single precision.
    LeakyBounces,
    /// Rows of form factors scaled to sum to 1.
    NormalisedRows,
    /// Receivers cast rays from their own hemisphere to find the lamp.
    Gathering,
}

impl NaiveMethod {
    /// The measure that shows its failure.
    pub fn measure(self) -> &'static str {
        match self {
            NaiveMethod::SingleTriangles
            | NaiveMethod::UnweldedTriangles
            | NaiveMethod::TrustedFaces => "leaks",
            NaiveMethod::SingleDistances => "torn",
            NaiveMethod::TrustedNormals => "no_numbers",
            NaiveMethod::ClosedFaces | NaiveMethod::OpenFaces | NaiveMethod::UnboundedPlanes => {
                "owners"
            }
            NaiveMethod::AddedSteps | NaiveMethod::Millimetre => "astray",
            NaiveMethod::DepositedRadiosity => "brightest",
            NaiveMethod::SingleSums => "closure",
            NaiveMethod::LeakyBounces | NaiveMethod::NormalisedRows => "exact",
            NaiveMethod::Gathering => "dark",
        }
    }

    /// Its description on the page.
    pub fn words(self) -> &'static str {
        match self {
            NaiveMethod::SingleTriangles => "triangles in single precision, world coordinates",
            NaiveMethod::UnweldedTriangles => "corners of each polygon rounded by themselves",
            NaiveMethod::SingleDistances => "distances in single precision",
            NaiveMethod::TrustedFaces => "faces believed to be planar and convex",
            NaiveMethod::TrustedNormals => "normals divided by no length",
            NaiveMethod::ClosedFaces => "interfaces with their edges: <=",
            NaiveMethod::OpenFaces => "interfaces without their edges: <",
            NaiveMethod::UnboundedPlanes => "interfaces as planes without end",
            NaiveMethod::AddedSteps => "a grid walk that adds steps up and divides by zero",
            NaiveMethod::Millimetre => "hits within a millimetre ignored",
            NaiveMethod::DepositedRadiosity => "radiosity deposited, not energy",
            NaiveMethod::SingleSums => "energy summed in single precision",
            NaiveMethod::LeakyBounces => "single precision's leaks, bounce after bounce",
            NaiveMethod::NormalisedRows => "form factors made to sum to 1",
            NaiveMethod::Gathering => "receivers look for the lamp by rays of their own",
        }
    }
}
