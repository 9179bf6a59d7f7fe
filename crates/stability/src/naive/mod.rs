//! Naive methods: slow implementations that make one known mistake each. Only cases use them.

mod energy; // energy stored and summed in ways that lose it
mod epsilon; // hits near the start of a ray are ignored
mod faces; // faces used as the file has them
mod gather; // receivers search for the lamp
mod march; // rays passed between environments without a rule for edges
mod single; // triangles in single precision
mod walk; // the grid walk of the textbook

use crate::cases::naive_method::{MAX_RAYS, NaiveMethod};
use crate::checks::rays;
use crate::finding::Quantity;
use crate::naive::march::Interface;
use crate::naive::single::Corners;
use crate::runs::CaseRuns;

/// What a naive method does with a case, by the measure that shows its failure.
pub fn run(method: NaiveMethod, runs: &CaseRuns) -> Quantity {
    match method {
        NaiveMethod::SingleTriangles => Quantity::Count(single::leaks(runs, Corners::Shared)),
        NaiveMethod::UnweldedTriangles => Quantity::Count(single::leaks(runs, Corners::Own)),
        NaiveMethod::SingleDistances => Quantity::Count(rays::torn(runs, MAX_RAYS, single::last)),
        NaiveMethod::TrustedFaces => {
            faces::leaks(runs).map_or_else(Quantity::Words, Quantity::Count)
        }
        NaiveMethod::TrustedNormals => {
            faces::no_normals(runs).map_or_else(Quantity::Words, Quantity::Whole)
        }
        NaiveMethod::ClosedFaces => Quantity::Count(march::owners(runs, Interface::Closed)),
        NaiveMethod::OpenFaces => Quantity::Count(march::owners(runs, Interface::Open)),
        NaiveMethod::UnboundedPlanes => Quantity::Count(march::owners(runs, Interface::Unbounded)),
        NaiveMethod::AddedSteps => Quantity::Count(rays::astray(runs, MAX_RAYS, walk::end)),
        NaiveMethod::Millimetre => Quantity::Count(rays::astray(runs, MAX_RAYS, epsilon::end)),
        NaiveMethod::DepositedRadiosity => Quantity::Number(energy::brightest(runs)),
        NaiveMethod::SingleSums => Quantity::Number(energy::closure(runs)),
        NaiveMethod::LeakyBounces => Quantity::Number(energy::leaky(runs)),
        NaiveMethod::NormalisedRows => Quantity::Number(energy::normalised(runs)),
        NaiveMethod::Gathering => Quantity::Count(gather::dark(runs)),
    }
}
