//! Cache misses of the processor model, compared with those that valgrind counts for the same shots in caches of
//! the same geometry.

use std::fmt::Write;
use std::process::Command;
use std::sync::Arc;

use multicomputer::{CacheLevel, Caches};
use serde::Serialize;
use virtwall::{Layout, Problem, Source, Storage};

use crate::callgrind;
use crate::command::run;
use crate::cpu::{Spread, rounded};
use crate::host::Host;
use crate::shots;

/// Scenes, and the numbers of local environments.
const SCENES: [&str; 3] = ["office", "rooms", "building"];
const ENVIRONMENTS: [u32; 3] = [1, 8, 56];
/// Valgrind's shortest cache line, bytes. Shorter lines are lengthened to this, in the model and in valgrind.
const SHORTEST_LINE: u64 = 32;

/// Lights shot in each scene. The first ones fill the caches and are not counted.
const LIGHTS: usize = 3;
const UNCOUNTED: usize = 1;

/// Placements of arrays and stack in memory. They are arbitrary, and decide which data conflict in a
/// direct-mapped cache: of 400 placements in the model one had 34 times the median of misses. So both sides
/// take the median of many placements. For the native kernel two things vary: the size from which the allocator
/// gives an array its own pages, and the start of the stack, in steps of `STACK` bytes.
const OWN_PAGES: [u64; 4] = [4_096, 16_384, 131_072, 1 << 30];
const STACK: usize = 6_704;
const PLACEMENTS: usize = 16;
/// Translations of addresses depend little on the placement.
const PLACEMENTS_OF_PAGES: usize = 4;
/// In the model every array gets another address each time.
const PLACEMENTS_OF_MODEL: usize = 40;

/// The layout of the native kernel's records. Of the 120 B of a polygon every test reads normal and offset; a test
/// whose ray meets the plane also reads where the edges are.
const NATIVE: Layout = Layout {
    direction: 24,
    cell: [4, 8],
    entry: 4,
    crossing: 8,
    plane: [120, 32, 56],
    edges: [96, 24],
    number: 4,
    axes: [80, 80],
    slot: 4,
    patch: [304, 96, 16],
    scalars: Layout::PLAIN_C.scalars,
    padding_seed: None,
    by_environment: false,
};

/// One scene in the caches of one machine.
#[derive(Serialize)]
pub struct Row {
    pub machine: String,
    pub scene: String,
    pub local_environments: u32,
    /// The level; 1 is nearest to the processor, `pages` is the translation look-aside buffer.
    pub level: &'static str,
    /// Shots, each through one environment, including the uncounted ones.
    pub shots: usize,
    /// Loads and stores of the native kernel, millions.
    pub references: f64,
    /// Per cent of them that miss this level, counted by valgrind.
    pub percent: f64,
    /// The same by the model.
    pub percent_model: f64,
    /// The ratio of model to valgrind.
    pub ratio: f64,
    /// Least and greatest count of valgrind over all placements, relative to its median.
    pub spread: String,
    /// The same for the model.
    pub spread_model: String,
}

/// Data references and misses of both levels.
type Counts = [u64; 3];

/// Measures every scene and decomposition in the caches of a machine.
pub fn measure(machine: &str) -> Result<Vec<Row>, String> {
    let (levels, pages) = levels(machine)?;
    let mut all = Vec::new();
    for scene in SCENES {
        for environments in ENVIRONMENTS {
            let caches = (["1", "2"], &levels, PLACEMENTS);
            let mut rows = rows(machine, caches, scene, environments)?;
            if let Some(pages) = &pages {
                // Valgrind simulates the look-aside buffer as a cache.
                let pages = (["pages", ""], pages, PLACEMENTS_OF_PAGES);
                let found = self::rows(machine, pages, scene, environments)?;
                rows.extend(found.into_iter().take(1));
            }
            let ratios: Vec<String> = rows.iter().map(|row| row.ratio.to_string()).collect();
            eprintln!("{scene} {environments}: {}", ratios.join(" "));
            all.extend(rows);
        }
    }
    Ok(all)
}

/// The two levels of a machine's caches as valgrind can simulate them, and its translations as two such levels.
fn levels(machine: &str) -> Result<([CacheLevel; 2], Option<[CacheLevel; 2]>), String> {
    let plan = shots::plan(&[&format!("machine={machine}")])?;
    let processor = &plan.machines[0].machine.processor;
    let levels = <[CacheLevel; 2]>::try_from(processor.caches.clone()).map_err(|levels| {
        format!("{machine}: found {} levels of caches; expected 2", levels.len())
    })?;
    let pages = processor.translations.clone().map(|pages| [pages.clone(), pages]);
    let as_valgrind = |level: CacheLevel| {
        let line = level.line.max(SHORTEST_LINE);
        CacheLevel { line, ..level }
    };
    Ok((levels.map(as_valgrind), pages))
}

fn rows(
    machine: &str,
    (names, levels, placements): ([&'static str; 2], &[CacheLevel; 2], usize),
    scene: &str,
    environments: u32,
) -> Result<Vec<Row>, String> {
    let count = |placement: usize| {
        let place = (OWN_PAGES[placement % OWN_PAGES.len()], STACK * placement);
        counted(scene, environments, levels, place)
    };
    let threads = parallel::host_threads();
    let counts = parallel::map(placements, threads, count);
    let counts = counts.into_iter().collect::<Result<Vec<Counts>, String>>()?;
    let problem = shots::problem(scene, environments)?;
    let shots = shots::of_lights(&problem, LIGHTS);
    let model = |seed: usize| modelled(&problem, &shots, levels, seed as u64);
    let models = parallel::map(PLACEMENTS_OF_MODEL, threads, model);
    let [references, ..] = counts[0];
    let percent = |misses: f64| rounded(100.0 * misses / references as f64);
    let row = |level: usize| {
        let (counted, spread_counted) = spread(counts.iter().map(|counts| counts[level + 1]));
        let (modelled, spread_modelled) = spread(models.iter().map(|misses| misses[level]));
        Row {
            machine: machine.to_owned(),
            scene: scene.to_owned(),
            local_environments: environments,
            level: names[level],
            shots: shots.len(),
            references: rounded(references as f64 / 1e6),
            percent: percent(counted),
            percent_model: percent(modelled),
            ratio: rounded(modelled / counted),
            spread: spread_counted,
            spread_model: spread_modelled,
        }
    };
    Ok((0..levels.len()).map(row).collect())
}

/// Valgrind's counts of the native kernel.
fn counted(
    scene: &str,
    environments: u32,
    levels: &[CacheLevel],
    (own_pages, stack): (u64, usize),
) -> Result<Counts, String> {
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--I1=16384,2,32");
    for (name, CacheLevel { size, ways, line, .. }) in ["D1", "LL"].iter().zip(levels) {
        valgrind.arg(format!("--{name}={size},{ways},{line}"));
    }
    valgrind.arg("--toggle-collect=peers::shots::counted");
    valgrind.env("MALLOC_MMAP_THRESHOLD_", own_pages.to_string()).env("PADDING", "-".repeat(stack));
    let arguments = ["shots", scene, &environments.to_string()].map(str::to_owned);
    let text = callgrind::run(valgrind, &own, &arguments, folder.path())?;
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

/// The number of shots that are not counted.
fn uncounted(shots: &[Source]) -> usize {
    shots.len() * UNCOUNTED / LIGHTS
}

/// Misses of each level in the model. `seed` is for random padding between arrays.
fn modelled(
    problem: &Arc<Problem>,
    shots: &[Source],
    levels: &[CacheLevel],
    seed: u64,
) -> Vec<u64> {
    let caches = Caches::new(levels, None);
    let mut storage = Storage::new(problem, Layout { padding_seed: Some(seed), ..NATIVE }, caches);
    let (first, others) = shots.split_at(uncounted(shots));
    first.iter().for_each(|source| storage.shoot(source));
    let before: Vec<u64> = storage.caches().misses().collect();
    others.iter().for_each(|source| storage.shoot(source));
    storage.caches().misses().zip(before).map(|(after, before)| after - before).collect()
}

/// Misses over all placements: their median, a whole number, and in words the others relative to it.
fn spread(misses: impl Iterator<Item = u64>) -> (f64, String) {
    let Spread { least, median, greatest } = Spread::of(misses.map(|n| n as f64).collect());
    let median = median.floor();
    (median, format!("{:.2}–{:.2}", least / median, greatest / median))
}

/// The native program that valgrind runs.
pub fn native(scene: &str, environments: u32) -> Result<(), String> {
    let problem = shots::problem(scene, environments)?;
    let shots = shots::of_lights(&problem, LIGHTS);
    println!("{}", shots::carry_out(&problem, &shots, uncounted(&shots)));
    Ok(())
}

/// The README of the results: method, host and table.
pub fn readme(rows: &[Row]) -> Result<String, String> {
    let head = include_str!("../README-of-caches.md");
    let valgrind = run(Command::new("valgrind").arg("--version"), "valgrind")?;
    Ok(format!("{head}- {}\n{}{}", valgrind.trim(), Host::here().list(), table(rows)))
}

pub fn table(rows: &[Row]) -> String {
    let mut text = String::from(
        "\n| machine | scene | environments | shots | million references | level | misses, % | model, % | \
         model over valgrind |\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for row in rows {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.0} | {} | {:.3} ({}) | {:.3} ({}) | {:.2} |",
            row.machine,
            row.scene,
            row.local_environments,
            row.shots,
            row.references,
            row.level,
            row.percent,
            row.spread,
            row.percent_model,
            row.spread_model,
            row.ratio,
        );
    }
    let within = rows.iter().filter(|row| (1.0 / 1.5..=1.5).contains(&row.ratio)).count();
    let _ = writeln!(text, "\n{within} of {} are within a factor of 1.5.", rows.len());
    text
}
