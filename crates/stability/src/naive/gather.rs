//! Receivers that look for a lamp.

use radiosity::{End, Ray};

use crate::bench::Bench;
use crate::direct::{lamps_and_others, sees};
use crate::finding::Count;
use crate::rays::{follow, rays};

/// Patches that see a lamp and that find it with none of their own rays.
pub fn dark(bench: &Bench) -> Count {
    let mut count = Count::default();
    for trial in &bench.trials {
        let problem = &*trial.problem;
        let (lamps, others) = lamps_and_others(bench, trial);
        for lamp in &lamps {
            for patch in others.iter().filter(|patch| sees(problem, patch, lamp)) {
                let finds = |ray: &Ray| {
                    let end = follow(problem, patch, ray);
                    matches!(end, End::Hit { polygon, .. } if polygon == lamp.polygon)
                };
                let dark = !rays(bench, problem, patch).iter().any(finds);
                count = count.and(Count { wrong: u64::from(dark), of: 1 });
            }
        }
    }
    count
}
