//! Naive methods by name.

use schemars::JsonSchema;
use serde::Deserialize;

/// Rays that a twin casts at most: they are slow.
pub const MOST_RAYS: u64 = 200_000;

/// A naive method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Twin {
    /// Triangles in single precision and world coordinates, tested as Möller and Trumbore do.
    SingleTriangles,
    /// The same where each polygon keeps its first corner and its edges, in single precision, so that
    /// corners that neighbours share differ.
    UnweldedTriangles,
    /// Triangles in single precision; of several at one distance the last one wins.
    SingleDistances,
    /// Polygons taken as the file has them: planar, convex.
    TrustedFaces,
    /// Normals of polygons as the file has them, divided by lengths that may be none.
    TrustedNormals,
    /// Neighbours whose face, its edges included, a ray meets: all of them.
    ClosedFaces,
    /// Neighbours whose face, its edges left out, a ray meets.
    OpenFaces,
    /// Neighbours whose plane a ray meets, wherever.
    UnboundedPlanes,
    /// A grid walk that adds steps up and divides by directions that may be zero.
    AddedSteps,
    /// Hits closer than a millimetre count as the ray's own start.
    Millimetre,
    /// Radiosity deposited over the patch's own area, however small.
    DepositedRadiosity,
    /// Energy summed ray by ray in single precision.
    SingleSums,
    /// A radiosity solution whose rays leak as single precision's do.
    LeakyBounces,
    /// Form factors made to sum to 1.
    NormalisedRows,
    /// Receivers that look for the lamp with a hemisphere of their own.
    Gathering,
}

impl Twin {
    /// The measure by which it is shown.
    pub fn measure(self) -> &'static str {
        match self {
            Twin::SingleTriangles | Twin::UnweldedTriangles | Twin::TrustedFaces => "leaks",
            Twin::SingleDistances => "torn",
            Twin::TrustedNormals => "no_numbers",
            Twin::ClosedFaces | Twin::OpenFaces | Twin::UnboundedPlanes => "owners",
            Twin::AddedSteps | Twin::Millimetre => "astray",
            Twin::DepositedRadiosity => "brightest",
            Twin::SingleSums => "closure",
            Twin::LeakyBounces | Twin::NormalisedRows => "exact",
            Twin::Gathering => "dark",
        }
    }

    /// What it does, in words.
    pub fn words(self) -> &'static str {
        match self {
            Twin::SingleTriangles => "triangles in single precision, world coordinates",
            Twin::UnweldedTriangles => "corners of each polygon rounded by themselves",
            Twin::SingleDistances => "distances in single precision",
            Twin::TrustedFaces => "faces believed to be planar and convex",
            Twin::TrustedNormals => "normals divided by no length",
            Twin::ClosedFaces => "interfaces with their edges: <=",
            Twin::OpenFaces => "interfaces without their edges: <",
            Twin::UnboundedPlanes => "interfaces as planes without end",
            Twin::AddedSteps => "a grid walk that adds steps up and divides by zero",
            Twin::Millimetre => "hits within a millimetre ignored",
            Twin::DepositedRadiosity => "radiosity deposited, not energy",
            Twin::SingleSums => "energy summed in single precision",
            Twin::LeakyBounces => "single precision's leaks, bounce after bounce",
            Twin::NormalisedRows => "form factors made to sum to 1",
            Twin::Gathering => "receivers look for the lamp by rays of their own",
        }
    }
}
