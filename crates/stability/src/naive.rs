//! Naive methods, each a slow twin of one thing that is done with care elsewhere. They are kept as
//! switches of the cases and are used for nothing else.

mod energy;
mod epsilon;
mod faces;
mod gather;
mod march;
mod single;
mod walk;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::bench::Bench;
use crate::rays;
use crate::right::Said;

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

    /// What it makes of a case.
    pub fn show(self, bench: &Bench) -> Said {
        match self {
            Twin::SingleTriangles => Said::Count(single::leaks(bench, single::Corners::Shared)),
            Twin::UnweldedTriangles => Said::Count(single::leaks(bench, single::Corners::Own)),
            Twin::SingleDistances => Said::Count(rays::torn(bench, MOST_RAYS, single::last)),
            Twin::TrustedFaces => faces::leaks(bench).map_or_else(Said::Words, Said::Count),
            Twin::TrustedNormals => faces::no_normals(bench).map_or_else(Said::Words, Said::Whole),
            Twin::ClosedFaces => Said::Count(march::owners(bench, march::Interface::Closed)),
            Twin::OpenFaces => Said::Count(march::owners(bench, march::Interface::Open)),
            Twin::UnboundedPlanes => Said::Count(march::owners(bench, march::Interface::Unbounded)),
            Twin::AddedSteps => Said::Count(rays::astray(bench, MOST_RAYS, walk::end)),
            Twin::Millimetre => Said::Count(rays::astray(bench, MOST_RAYS, epsilon::end)),
            Twin::DepositedRadiosity => Said::Number(energy::brightest(bench)),
            Twin::SingleSums => Said::Number(energy::closure(bench)),
            Twin::LeakyBounces => Said::Number(energy::leaky(bench)),
            Twin::NormalisedRows => Said::Number(energy::normalised(bench)),
            Twin::Gathering => Said::Count(gather::dark(bench)),
        }
    }
}
