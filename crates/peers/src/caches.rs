//! Misses as the model of a processor's caches has them, beside those that valgrind counts of the same
//! shots in caches of the same geometry.

use std::fmt::Write;
use std::process::Command;
use std::sync::Arc;

use multicomputer::CacheLevel;
use radiosity::shoot;
use serde::Serialize;
use virtwall::{Layout, Problem, Storage};

use crate::command::run;
use crate::cpu::rounded;
use crate::shots;

/// Scenes and how they are cut.
const SCENES: [&str; 3] = ["office", "rooms", "building"];
const ENVIRONMENTS: [u32; 3] = [1, 8, 56];
/// Lights shot in each.
const LIGHTS: usize = 8;

/// First caches, ways and bytes a line: as large as an UltraSPARC-I has it, and that of an i860 XP. (Valgrind
/// knows no lines of 16 B.)
const FIRST: [(u64, u64, u64); 2] = [(16_384, 1, 32), (16_384, 4, 32)];
/// The second: size, ways, bytes a line.
const SECOND: (u64, u64, u64) = (524_288, 1, 64);

/// Where arrays begin in memory is luck, and decides which of them fall on each other in a direct-mapped
/// cache. Of three placements the median counts, valgrind's and the model's: bytes from which the
/// allocator gives an array pages of its own, and bytes that the model leaves between arrays.
const PLACEMENTS: [u64; 3] = [4_096, 131_072, 1 << 30];
const GAPS: [u64; 3] = [16, 1_040, 5_008];

/// The native kernel's records. Its polygons are 120 B, of which a test of the plane reads the
/// better part; a pixel's weight is read where it ends. Frames of the three functions inside each other
/// (1.4 KB as compiled) and the planes of the grid are in constant use.
const NATIVE: Layout = Layout {
    direction: 24,
    weight: 8,
    cell: 4,
    entry: 4,
    polygon: [120, 88],
    edges: [96, 96],
    slot: 4,
    form_factor: 8,
    patch: [96, 8],
    hot: 2_048,
    gap: 0,
    by_environment: false,
};

/// One scene in one pair of caches.
#[derive(Serialize)]
pub struct Row {
    /// The scene.
    pub scene: String,
    /// Local environments.
    pub local_environments: u32,
    /// Ways of the first cache.
    pub ways: u64,
    /// Its line, bytes.
    pub line: u64,
    /// Shots, through an environment each.
    pub shots: u64,
    /// Loads and stores of the native kernel, millions.
    pub references: f64,
    /// Per cent of them that miss the first cache, as valgrind counts them.
    pub first_percent: f64,
    /// The same as the model has it.
    pub first_percent_model: f64,
    /// The model's over valgrind's.
    pub first_ratio: f64,
    /// The least and the greatest that valgrind counts, as the arrays lie, over its median.
    pub first_spread: String,
    /// The same of the model.
    pub first_spread_model: String,
    /// The same of the second cache.
    pub second_percent: f64,
    /// The same of the second cache.
    pub second_percent_model: f64,
    /// The same of the second cache.
    pub second_ratio: f64,
    /// The same of the second cache.
    pub second_spread: String,
    /// The same of the second cache.
    pub second_spread_model: String,
}

/// Data references and misses of both levels.
type Counts = [u64; 3];

/// Measure every scene, cut and geometry.
///
/// # Errors
/// When valgrind does not run, or a scene is missing.
pub fn measure() -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for first in FIRST {
        for scene in SCENES {
            for environments in ENVIRONMENTS {
                let row = row(scene, environments, first)?;
                eprintln!("{scene} {environments}: {} {}", row.first_ratio, row.second_ratio);
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

fn row(scene: &str, environments: u32, first: (u64, u64, u64)) -> Result<Row, String> {
    let counts = PLACEMENTS.map(|placement| counted(scene, environments, first, placement));
    let counts = counts.into_iter().collect::<Result<Vec<Counts>, String>>()?;
    let problem = shots::problem(scene, environments)?;
    let models = GAPS.map(|gap| modelled(&problem, first, gap));
    let shots = models[0].0;
    let [references, ..] = counts[0];
    let of_level = |level: usize| {
        let counted = Spread::of(counts.iter().map(|counts| counts[level + 1]));
        let modelled = Spread::of(models.iter().map(|(_, misses)| misses[level]));
        let ratio = rounded(modelled.median as f64 / counted.median as f64);
        let percent = |misses: u64| rounded(100.0 * misses as f64 / references as f64);
        (percent(counted.median), percent(modelled.median), ratio, counted.text(), modelled.text())
    };
    let (first_percent, first_percent_model, first_ratio, first_spread, first_spread_model) =
        of_level(0);
    let (second_percent, second_percent_model, second_ratio, second_spread, second_spread_model) =
        of_level(1);
    Ok(Row {
        scene: scene.to_owned(),
        local_environments: environments,
        ways: first.1,
        line: first.2,
        shots,
        references: rounded(references as f64 / 1e6),
        first_percent,
        first_percent_model,
        first_ratio,
        first_spread,
        first_spread_model,
        second_percent,
        second_percent_model,
        second_ratio,
        second_spread,
        second_spread_model,
    })
}

/// What valgrind counts of the native kernel.
fn counted(
    scene: &str,
    environments: u32,
    first: (u64, u64, u64),
    placement: u64,
) -> Result<Counts, String> {
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let output = folder.path().join("callgrind.out");
    let geometry = |(size, ways, line): (u64, u64, u64)| format!("{size},{ways},{line}");
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--quiet", "--tool=callgrind", "--cache-sim=yes"]);
    valgrind.args(["--I1=16384,2,32".to_owned(), format!("--D1={}", geometry(first))]);
    valgrind.arg(format!("--LL={}", geometry(SECOND)));
    valgrind.arg("--toggle-collect=peers::shots::shoot_and_update");
    valgrind.arg(format!("--callgrind-out-file={}", output.display()));
    valgrind.env("MALLOC_MMAP_THRESHOLD_", placement.to_string());
    valgrind.arg(own).args(["shots", scene, &environments.to_string()]);
    run(&mut valgrind, "valgrind")?;
    let text = std::fs::read_to_string(&output).map_err(|error| error.to_string())?;
    totals(&text).ok_or_else(|| "valgrind: found no totals".to_owned())
}

/// Data references and misses from the totals of callgrind's output.
fn totals(text: &str) -> Option<Counts> {
    let line = |name: &str| text.lines().find_map(|line| line.strip_prefix(name));
    let events: Vec<&str> = line("events: ")?.split(' ').collect();
    let totals: Vec<u64> =
        line("totals: ")?.split(' ').map(|count| count.parse().unwrap_or(0)).collect();
    let of = |name: &str| {
        let place = events.iter().position(|event| *event == name);
        place.and_then(|place| totals.get(place)).copied().unwrap_or(0)
    };
    Some([of("Dr") + of("Dw"), of("D1mr") + of("D1mw"), of("DLmr") + of("DLmw")])
}

/// Shots, and what the model has of them.
fn modelled(problem: &Arc<Problem>, first: (u64, u64, u64), gap: u64) -> (u64, Vec<u64>) {
    let level = |(size, ways, line)| CacheLevel { size, ways, line, miss_time: 0.0 };
    let mut storage = Storage::new(problem, Layout { gap, ..NATIVE }, &[first, SECOND].map(level));
    let mut shots = 0;
    shots::shoot_lights(problem, LIGHTS, |parcel| {
        storage.shoot(parcel);
        shots += 1;
        let environment = &problem.environments[parcel.environment as usize];
        shoot(&problem.space, environment, &problem.hemisphere, &parcel.source, &parcel.mask)
    });
    (shots, storage.misses())
}

/// Misses as arrays lie.
struct Spread {
    least: u64,
    median: u64,
    greatest: u64,
}

impl Spread {
    fn of(misses: impl Iterator<Item = u64>) -> Spread {
        let mut all: Vec<u64> = misses.collect();
        all.sort_unstable();
        Spread { least: all[0], median: all[all.len() / 2], greatest: all[all.len() - 1] }
    }

    fn text(&self) -> String {
        let [least, greatest] = [self.least, self.greatest].map(|n| n as f64 / self.median as f64);
        format!("{least:.2}–{greatest:.2}")
    }
}

/// The native program that valgrind watches.
///
/// # Errors
/// What is wrong with the scene.
pub fn native(scene: &str, environments: u32) -> Result<(), String> {
    println!("{}", shots::run(&*shots::problem(scene, environments)?, LIGHTS));
    Ok(())
}

/// What was found, for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "\n| first cache | scene | environments | shots | million references | misses of the first, % \
         | model, % | model over valgrind | misses of the second, % | model, % | model over valgrind |\n\
         |---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {}-way | {} | {} | {} | {:.0} | {:.2} ({}) | {:.2} ({}) | **{:.2}** | {:.3} ({}) | \
             {:.3} ({}) | **{:.2}** |",
            row.ways,
            row.scene,
            row.local_environments,
            row.shots,
            row.references,
            row.first_percent,
            row.first_spread,
            row.first_percent_model,
            row.first_spread_model,
            row.first_ratio,
            row.second_percent,
            row.second_spread,
            row.second_percent_model,
            row.second_spread_model,
            row.second_ratio,
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn totals_are_read_by_the_names_of_their_events() {
        let text = "events: Ir Dr Dw I1mr D1mr D1mw ILmr DLmr DLmw\ntotals: 9 5 4 0 3 2 0 1 1\n";
        assert_eq!(totals(text), Some([9, 5, 2]));
        assert_eq!(totals("events: Ir\n"), None);
    }
}
