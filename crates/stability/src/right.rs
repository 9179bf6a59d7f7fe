//! What right means, and what was found.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::bench::Bench;
use crate::direct;
use crate::light;
use crate::naive::Twin;
use crate::rays::{self, Count};

/// What is right, by measure; each measure that has a value is made over all runs of the case.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Right {
    /// Rays of a closed scene that leave it: at most so many.
    pub leaks: Option<u64>,
    /// Rays that end elsewhere than on the nearest of all polygons: at most so many.
    pub astray: Option<u64>,
    /// Pixels that do not end exactly once over all local environments: at most so many.
    pub owners: Option<u64>,
    /// Rays that meet several polygons of one plane, and do not end on that on which most of their like
    /// do: at most so many.
    pub torn: Option<u64>,
    /// Patches that see a light and get nothing of it: at most so many.
    pub dark: Option<u64>,
    /// Share of the emitted energy that is unaccounted for: at most so much.
    pub closure: Option<f64>,
    /// Greatest radiosity that a patch gets from others, over the greatest emitted: at most so much.
    pub brightest: Option<f64>,
    /// Mean radiosities of objects, where they are known.
    pub exact: Option<Exact>,
    /// Relative L2 difference between the light of the first run and that of any other: at most so much.
    pub same_light: Option<f64>,
    /// Radiosities that are no numbers: exactly so many, none that is.
    pub no_numbers: Option<u64>,
    /// Sources shot from their own local environments: exactly so many, over all runs.
    pub shots: Option<u64>,
    /// How all runs end.
    pub ends: Option<String>,
    /// A part of a warning that is given.
    pub warns: Option<String>,
    /// A part of the message with which the experiment is refused.
    pub refused: Option<String>,
}

/// Mean radiosities that are known.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Exact {
    /// Of each object, red, W/m².
    pub radiosity: BTreeMap<String, f64>,
    /// The greatest relative error.
    pub within: f64,
    /// Whether an error is right as well that is no greater than the share of the emitted energy that
    /// the run says is not shot yet: it has not converged, and tells.
    #[serde(default)]
    pub or_told: bool,
}

impl Right {
    /// Whether a measure of this name is asked for.
    pub fn asks(&self, measure: &str) -> bool {
        match measure {
            "leaks" => self.leaks.is_some(),
            "astray" => self.astray.is_some(),
            "owners" => self.owners.is_some(),
            "torn" => self.torn.is_some(),
            "dark" => self.dark.is_some(),
            "closure" => self.closure.is_some(),
            "brightest" => self.brightest.is_some(),
            "exact" => self.exact.is_some(),
            "no_numbers" => self.no_numbers.is_some(),
            _ => false,
        }
    }
}

/// What was found, as it is told.
#[derive(Clone, Debug, PartialEq)]
pub enum Said {
    /// Wrong ones of all.
    Count(Count),
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// Words.
    Words(String),
}

impl Said {
    /// How wrong, as a share; none for words.
    pub fn share(&self) -> Option<f64> {
        match self {
            Said::Count(Count { of: 0, .. }) | Said::Words(_) | Said::Whole(_) => None,
            Said::Count(Count { wrong, of }) => Some(*wrong as f64 / *of as f64),
            Said::Number(number) => Some(*number),
        }
    }
}

/// What was found by one measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The measure's name.
    pub measure: &'static str,
    /// What is right.
    pub bound: Said,
    /// Ours.
    pub ours: Said,
    /// The naive method's; of this program under naive settings, only what is not right.
    pub naive: Option<Said>,
    /// Whether ours is right.
    pub holds: bool,
}

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
        finding.into_iter().for_each(|finding| finding.naive = Some(Twin::show(twin, bench)));
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

fn count(measure: &'static str, most: u64, ours: Count) -> Finding {
    let bound = Said::Count(Count { wrong: most, of: ours.of });
    let holds = ours.wrong <= most && ours.of > 0;
    Finding { measure, bound, ours: Said::Count(ours), naive: None, holds }
}

fn number(measure: &'static str, most: f64, ours: Result<f64, String>) -> Finding {
    let holds = ours.as_ref().is_ok_and(|&ours| ours <= most);
    let ours = ours.map_or_else(Said::Words, Said::Number);
    Finding { measure, bound: Said::Number(most), ours, naive: None, holds }
}

/// A whole number that must be what it is.
fn whole(measure: &'static str, exactly: u64, ours: Result<u64, String>) -> Finding {
    let holds = ours == Ok(exactly);
    let ours = ours.map_or_else(Said::Words, Said::Whole);
    Finding { measure, bound: Said::Whole(exactly), ours, naive: None, holds }
}

/// Words, a part of which must be there.
pub fn words(measure: &'static str, part: &str, ours: String) -> Finding {
    let holds = ours.contains(part);
    Finding {
        measure,
        bound: Said::Words(part.to_owned()),
        ours: Said::Words(ours),
        naive: None,
        holds,
    }
}
