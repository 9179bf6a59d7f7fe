//! Misses as the model of a processor's caches has them, beside those that valgrind counts of the same
//! shots in caches of the same geometry.

use std::fmt::Write;
use std::process::Command;

use multicomputer::CacheLevel;
use radiosity::shoot;
use serde::Serialize;
use virtwall::{Layout, Storage};

use crate::command::run;
use crate::cpu::rounded;
use crate::shots;

/// Scenes and how they are cut.
const SCENES: [&str; 3] = ["office", "rooms", "building"];
const ENVIRONMENTS: [u32; 3] = [1, 8, 56];
/// Lights shot in each.
const LIGHTS: usize = 8;

/// First caches, ways and bytes a line: of an UltraSPARC-I, and of an R10000 made half as large.
const FIRST: [(u64, u64, u64); 2] = [(16_384, 1, 16), (16_384, 2, 32)];
/// The second: size, ways, bytes a line.
const SECOND: (u64, u64, u64) = (524_288, 1, 64);

/// Where arrays begin in memory is luck, and decides which of them fall on each other in a direct-mapped
/// cache: allocators that place them differently, of which the median counts.
const PLACEMENTS: [u64; 3] = [4_096, 131_072, 1 << 30];

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
    /// The same of the second cache.
    pub second_percent: f64,
    /// The same of the second cache.
    pub second_percent_model: f64,
    /// The same of the second cache.
    pub second_ratio: f64,
    /// The same of the second cache.
    pub second_spread: String,
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
                rows.push(row(scene, environments, first)?);
            }
        }
    }
    Ok(rows)
}

fn row(scene: &str, environments: u32, first: (u64, u64, u64)) -> Result<Row, String> {
    let counts = PLACEMENTS.map(|placement| counted(scene, environments, first, placement));
    let counts = counts.into_iter().collect::<Result<Vec<Counts>, String>>()?;
    let (shots, model) = modelled(scene, environments, first)?;
    let [references, ..] = counts[0];
    let percent = |misses: u64| 100.0 * misses as f64 / references as f64;
    let level = |level: usize| {
        let mut found: Vec<u64> = counts.iter().map(|counts| counts[level + 1]).collect();
        found.sort_unstable();
        let median = found[found.len() / 2] as f64;
        let spread = [found[0], found[found.len() - 1]].map(|n| n as f64 / median);
        let ratio = rounded(model[level] as f64 / median);
        (percent(median as u64), ratio, format!("{:.2}-{:.2}", spread[0], spread[1]))
    };
    let ((first_percent, first_ratio, first_spread), (second_percent, second_ratio, second_spread)) =
        (level(0), level(1));
    Ok(Row {
        scene: scene.to_owned(),
        local_environments: environments,
        ways: first.1,
        line: first.2,
        shots,
        references: rounded(references as f64 / 1e6),
        first_percent: rounded(first_percent),
        first_percent_model: rounded(percent(model[0])),
        first_ratio,
        first_spread,
        second_percent: rounded(second_percent),
        second_percent_model: rounded(percent(model[1])),
        second_ratio,
        second_spread,
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
fn modelled(
    scene: &str,
    environments: u32,
    first: (u64, u64, u64),
) -> Result<(u64, [u64; 2]), String> {
    let problem = shots::problem(scene, environments)?;
    let level = |(size, ways, line)| CacheLevel { size, ways, line, miss_time: 0.0 };
    let mut storage = Storage::new(&problem, NATIVE, &[first, SECOND].map(level));
    let mut shots = 0;
    shots::shoot_lights(&problem, LIGHTS, |parcel| {
        storage.shoot(parcel);
        shots += 1;
        let environment = &problem.environments[parcel.environment as usize];
        shoot(&problem.space, environment, &problem.hemisphere, &parcel.source, &parcel.mask)
    });
    let misses = storage.misses();
    Ok((shots, [misses[0], misses[1]]))
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
        "\n| first cache | scene | environments | shots | references, millions | misses of the first, % | \
         model, % | model over valgrind | spread | misses of the second, % | model, % | model over \
         valgrind | spread |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {}-way, {} B | {} | {} | {} | {:.1} | {:.2} | {:.2} | {:.2} | {} | {:.3} | {:.3} | \
             {:.2} | {} |",
            row.ways,
            row.line,
            row.scene,
            row.local_environments,
            row.shots,
            row.references,
            row.first_percent,
            row.first_percent_model,
            row.first_ratio,
            row.first_spread,
            row.second_percent,
            row.second_percent_model,
            row.second_ratio,
            row.second_spread
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
