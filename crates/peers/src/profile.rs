//! The profile of Table 1 and of the kernel, by perf and valgrind, function by function.

use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::TempDir;

use crate::callgrind::{Counts, count};
use crate::command::{cargo, run};
use crate::cpu::{clock, rounded};
use crate::perf::{Share, sample};

/// Number of sources for the kernel's profile: sampled by perf, and counted by the slower valgrind.
const SAMPLED: u32 = 1_024;
const COUNTED: u32 = 32;
const RAYS: u32 = 30_976;

/// A function and its cost, for each ray or in a run.
#[derive(Serialize)]
pub struct Part {
    pub function: String,
    pub percent: f64,
    /// Cycles of the processor.
    pub cycles: f64,
    /// Instructions; this and the following are empty if valgrind runs another version of the function.
    pub instructions: Option<f64>,
    /// Loads and stores that miss the first cache.
    pub cache_misses: Option<f64>,
    /// Mispredicted branches.
    pub wrong_branches: Option<f64>,
    /// Lower bound of the cycles of the instructions, per cent.
    pub instructions_percent: Option<f64>,
    /// Cycles of the cache misses if they do not overlap, per cent.
    pub cache_misses_percent: Option<f64>,
    /// Cycles of the mispredicted branches, per cent.
    pub wrong_branches_percent: Option<f64>,
}

/// Cycles of an instruction (lower bound), of a line from the second cache, and of a mispredicted branch: assumed,
/// those of Intel's Golden Cove.
const COSTS: [f64; 3] = [1.0 / 6.0, 14.0, 17.0];

impl Part {
    fn new(share: Share, cycles: f64, counts: Option<[f64; 3]>) -> Part {
        let count = |i: usize| counts.map(|counts| rounded(counts[i]));
        let percent =
            |i: usize| counts.map(|counts| rounded(100.0 * counts[i] * COSTS[i] / cycles));
        Part {
            function: share.function,
            percent: share.percent,
            cycles: rounded(cycles),
            instructions: count(0),
            cache_misses: count(1),
            wrong_branches: count(2),
            instructions_percent: percent(0),
            cache_misses_percent: percent(1),
            wrong_branches_percent: percent(2),
        }
    }
}

pub struct Profile {
    /// Functions of the whole run of Table 1, the greatest share first.
    pub table1: Vec<Share>,
    /// Functions of its Office part, counts in millions.
    pub office: Vec<Part>,
    /// Functions of the kernel on the scene `rooms`, counts for each ray.
    pub kernel: Vec<Part>,
    /// Clock rate of this processor under load, hertz; used to compute cycles.
    pub clock: f64,
}

/// Profiles Table 1 and the kernel, one thread each.
pub fn measure(folder: &TempDir) -> Result<Profile, String> {
    let virtwall = build()?;
    let folder = folder.path();
    let (whole, _) = sample(&virtwall, &table1(folder, "whole", &[]), folder)?;
    // Each into its own folder, since runs found there would not be repeated.
    let office = |run| (table1(folder, run, &["--set", "scene=office"]), 1e6);
    let rays = |sources| (kernel(sources), f64::from(sources) * f64::from(RAYS));
    let clock = clock();
    let parts = |commands| parts(&virtwall, commands, clock, folder);
    Ok(Profile {
        table1: whole,
        office: parts(&["sampled", "counted"].map(office))?,
        kernel: parts(&[SAMPLED, COUNTED].map(rays))?,
        clock,
    })
}

/// Arguments that make Table 1 in `folder`/`run`.
fn table1(folder: &Path, run: &str, more: &[&str]) -> Vec<String> {
    let out = folder.join(run).display().to_string();
    let arguments = ["run", "experiments/table1.json", "--threads", "1", "--out", &out];
    arguments.iter().chain(more).map(|&word| word.to_owned()).collect()
}

/// Arguments that cast the rays of a number of sources.
fn kernel(sources: u32) -> Vec<String> {
    let (sources, rays) = (sources.to_string(), RAYS.to_string());
    ["bench", "rays", "rooms", "--sources", &sources, "--rays", &rays].map(str::to_owned).to_vec()
}

/// Samples one command and counts another that does the same work fewer times. Each comes with the number by which
/// its results are divided.
fn parts(
    virtwall: &Path,
    [(sampled, per_sampled), (counted, per_counted)]: &[(Vec<String>, f64); 2],
    clock: f64,
    folder: &Path,
) -> Result<Vec<Part>, String> {
    let (shares, seconds) = sample(virtwall, sampled, folder)?;
    let counts = count(virtwall, counted, folder)?;
    let part = |share: Share| {
        let counts = counts.get(&share.function).map(|counts| {
            let Counts { instructions, cache_misses, wrong_branches } = *counts;
            [instructions, cache_misses, wrong_branches].map(|n| n as f64 / per_counted)
        });
        let cycles = seconds * clock * share.percent / 100.0 / per_sampled;
        Part::new(share, cycles, counts)
    };
    Ok(shares.into_iter().map(part).collect())
}

/// Builds the `virtwall` command with the release profile.
fn build() -> Result<PathBuf, String> {
    run(cargo().args(["build", "--release", "--package", "cli"]), "cargo")?;
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    Ok(own.with_file_name("virtwall"))
}

pub fn table(profile: &Profile) -> String {
    let mut text = String::from("\n| Table 1, one thread | % of the time |\n|---|---:|\n");
    for Share { function, percent } in &profile.table1 {
        text += &format!("| `{function}` | {percent:.1} |\n");
    }
    text += &part_table("Office part, in millions", &profile.office, profile.clock);
    text += &part_table("kernel on the rooms, a ray", &profile.kernel, profile.clock);
    text
}

fn part_table(title: &str, parts: &[Part], clock: f64) -> String {
    let mut text = format!(
        "\n| {title} | % of the time | cycles at {:.2} GHz | instructions | % of cycles | \
         cache misses | % of cycles | wrong branches | % of cycles |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        clock / 1e9
    );
    let cell = |figure: Option<f64>, decimals: usize| {
        figure.map_or("–".to_owned(), |figure| format!("{figure:.decimals$}"))
    };
    for part in parts {
        let Part { function, percent, cycles, .. } = part;
        text += &format!("| `{function}` | {percent:.1} | {cycles:.1} ");
        for (figure, decimals) in [
            (part.instructions, 1),
            (part.instructions_percent, 0),
            (part.cache_misses, 2),
            (part.cache_misses_percent, 0),
            (part.wrong_branches, 2),
            (part.wrong_branches_percent, 0),
        ] {
            text += &format!("| {} ", cell(figure, decimals));
        }
        text += "|\n";
    }
    text
}
