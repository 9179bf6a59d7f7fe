//! Every measure of a case, made.

use crate::bench::Bench;
use crate::direct;
use crate::finding::{Finding, count, number, whole, words};
use crate::light;
use crate::naive;
use crate::rays;
use crate::right::Exact;

/// All findings of a case that is not to be refused; `naive` is the same case under naive settings.
pub fn findings(bench: &Bench, naive: Option<&Bench>) -> Vec<Finding> {
    let mut found = measures(bench);
    if let Some(naive) = naive {
        for (finding, naive) in found.iter_mut().zip(measures(naive)) {
            finding.naive = (!naive.holds).then_some(naive.ours);
        }
    }
    if let Some(twin) = bench.case.naive {
        let finding = found.iter_mut().find(|finding| finding.measure == twin.measure());
        finding.into_iter().for_each(|finding| finding.naive = Some(naive::show(twin, bench)));
    }
    found
}

fn measures(bench: &Bench) -> Vec<Finding> {
    let right = &bench.case.right;
    let exact = |right: &Exact| {
        let found = light::off_and_told(bench, right);
        let told = found.as_ref().map_or(0.0, |&(_, told)| if right.or_told { told } else { 0.0 });
        number("exact", right.within.max(told), found.map(|(off, _)| off))
    };
    let most = u64::MAX;
    [
        right.leaks.map(|bound| count("leaks", bound, rays::leaks(bench))),
        right.astray.map(|bound| count("astray", bound, rays::astray(bench, most, rays::ours))),
        right.owners.map(|bound| count("owners", bound, rays::owners(bench))),
        right.torn.map(|bound| count("torn", bound, rays::torn(bench, most, rays::our_polygon))),
        right.dark.map(|bound| count("dark", bound, direct::dark(bench))),
        right.closure.map(|bound| number("closure", bound, light::closure(bench))),
        right.brightest.map(|bound| number("brightest", bound, light::brightest(bench))),
        right.exact.as_ref().map(exact),
        right.same_light.map(|bound| number("same_light", bound, light::difference(bench))),
        right.no_numbers.map(|bound| whole("no_numbers", bound, light::no_numbers(bench))),
        right.shots.map(|bound| whole("shots", bound, light::shots(bench))),
        right.ends.as_ref().map(|part| words("ends", part, light::endings(bench))),
        right.warns.as_ref().map(|part| words("warns", part, bench.warnings.join("; "))),
    ]
    .into_iter()
    .flatten()
    .collect()
}
