//! All measures that a case asks for.

use crate::cases::expected::Exact;
use crate::checks::{direct, light, rays};
use crate::finding::{Finding, count, number, whole, words};
use crate::runs::CaseRuns;

/// The findings of a case, one for each bound that it has.
pub fn measures(runs: &CaseRuns) -> Vec<Finding> {
    let bounds = &runs.case.expected;
    let exact = |exact: &Exact| {
        let found = light::error_and_unshot(runs, exact);
        let unshot = found.as_ref().map_or(0.0, |&(_, unshot)| unshot);
        let bound = if exact.or_unshot { exact.within.max(unshot) } else { exact.within };
        number("exact", bound, found.map(|(error, _)| error))
    };
    let most = u64::MAX;
    [
        bounds.leaks.map(|bound| count("leaks", bound, rays::leaks(runs))),
        bounds.astray.map(|bound| count("astray", bound, rays::astray(runs, most, rays::ours))),
        bounds.owners.map(|bound| count("owners", bound, rays::owners(runs))),
        bounds.torn.map(|bound| count("torn", bound, rays::torn(runs, most, rays::our_polygon))),
        bounds.dark.map(|bound| count("dark", bound, direct::dark(runs))),
        bounds.closure.map(|bound| number("closure", bound, light::closure(runs))),
        bounds.brightest.map(|bound| number("brightest", bound, light::brightest(runs))),
        bounds.exact.as_ref().map(exact),
        bounds.same_light.map(|bound| number("same_light", bound, light::difference(runs))),
        bounds.no_numbers.map(|bound| whole("no_numbers", bound, light::no_numbers(runs))),
        bounds.shots.map(|bound| whole("shots", bound, light::shots(runs))),
        bounds.ends.as_ref().map(|part| words("ends", part, light::endings(runs))),
        bounds.warns.as_ref().map(|part| words("warns", part, runs.warnings().join("; "))),
    ]
    .into_iter()
    .flatten()
    .collect()
}
