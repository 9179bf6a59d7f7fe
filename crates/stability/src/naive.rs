//! Naive methods, each a slow twin of one thing that is done with care elsewhere. They are kept as
//! switches of the cases and are used for nothing else.

mod energy;
mod epsilon;
mod faces;
mod gather;
mod march;
mod single;
mod walk;

use crate::bench::Bench;
use crate::finding::Said;
use crate::rays;
use crate::twin::{MOST_RAYS, Twin};

/// What a naive method makes of a case.
pub fn show(twin: Twin, bench: &Bench) -> Said {
    match twin {
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
