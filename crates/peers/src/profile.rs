//! Where the time goes: what perf samples and valgrind counts, function by function.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Serialize;
use tempfile::TempDir;

use crate::callgrind::{self, Counts};
use crate::command::{cargo, run};
use crate::cpu::{rounded, timed};

/// Functions with less of the time than this many per cent are told together.
const LEAST: f64 = 1.5;

/// Sources of the kernel's profile, sampled and counted: a second, and a few under valgrind.
const SAMPLED: u32 = 1_024;
const COUNTED: u32 = 32;
const RAYS: u32 = 30_976;

/// Samples a second.
const FREQUENCY: &str = "5000";

/// Packages of Debian with what looks.
const PACKAGES: &str = "linux-perf valgrind";

/// A function and its own part of the time.
#[derive(Serialize)]
pub struct Share {
    /// The function, whatever processor it is compiled for.
    pub function: String,
    /// Per cent of the samples.
    pub percent: f64,
}

/// A function, and what it does for a ray, or in a run.
#[derive(Serialize)]
pub struct Part {
    /// As in [`Share`].
    pub function: String,
    /// As in [`Share`].
    pub percent: f64,
    /// Cycles of the processor.
    pub cycles: f64,
    /// Instructions; nothing here or below where valgrind runs another function in its place.
    pub instructions: Option<f64>,
    /// Loads and stores that miss the first cache.
    pub cache_misses: Option<f64>,
    /// Branches that are guessed wrong.
    pub wrong_branches: Option<f64>,
    /// Per cent of the cycles that the instructions take at the least.
    pub instructions_percent: Option<f64>,
    /// Per cent of the cycles that the cache misses take, one after the other.
    pub cache_misses_percent: Option<f64>,
    /// Per cent of the cycles that the wrong branches take.
    pub wrong_branches_percent: Option<f64>,
}

/// Cycles that an instruction takes at the least, that a line from the second cache takes, and that go
/// by until work goes on after a wrong branch: assumed, as Intel states them of its Golden Cove.
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

/// What was found.
pub struct Profile {
    /// Functions of Table 1's whole run, the greatest share first.
    pub table1: Vec<Share>,
    /// Those of its Office part, in millions.
    pub office: Vec<Part>,
    /// Those of the kernel on the rooms, a ray.
    pub kernel: Vec<Part>,
    /// Cycles a second of this processor while it is busy, on which cycles are based.
    pub clock: f64,
}

/// Profile Table 1 and the kernel, one thread each.
///
/// # Errors
/// What does not run, and the packages that hold it.
pub fn measure(folder: &TempDir) -> Result<Profile, String> {
    let virtwall = build()?;
    let folder = folder.path();
    let (whole, _) = sample(&virtwall, &table1(folder, "whole", &[]), folder)?;
    // Each into a folder of its own: runs found there would not be run again.
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

/// Arguments that cast the rays of so many sources.
fn kernel(sources: u32) -> Vec<String> {
    let (sources, rays) = (sources.to_string(), RAYS.to_string());
    ["bench", "rays", "rooms", "--sources", &sources, "--rays", &rays].map(str::to_owned).to_vec()
}

/// Sample one command and count another, which does the same as often or less often; each is given
/// with the number by which what is found is divided.
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

/// The `virtwall` command, as fast as a user has it.
fn build() -> Result<PathBuf, String> {
    run(cargo().args(["build", "--release", "--package", "cli"]), PACKAGES)?;
    let own = std::env::current_exe().map_err(|error| error.to_string())?;
    Ok(own.with_file_name("virtwall"))
}

/// Shares of the time by function, and processor seconds sampled.
fn sample(
    virtwall: &Path,
    arguments: &[String],
    folder: &Path,
) -> Result<(Vec<Share>, f64), String> {
    let data = folder.join("perf.data");
    // The clock is there in virtual machines too, where the processor's counters often are not.
    let mut perf = Command::new("perf");
    perf.args(["record", "--quiet", "-e", "cpu-clock:u", "-F", FREQUENCY, "-o"]).arg(&data);
    run(perf.arg("--").arg(virtwall).args(arguments), PACKAGES)?;
    let mut perf = Command::new("perf");
    perf.args(["report", "--stdio", "--no-children", "-F", "sample,symbol", "-i"]).arg(&data);
    let report = run(&mut perf, PACKAGES)?;
    let mut samples: BTreeMap<String, u64> = BTreeMap::new();
    for line in report.lines() {
        let Some((count, function)) = line.trim().split_once("[.]") else { continue };
        if let Ok(count) = count.trim().parse::<u64>() {
            *samples.entry(plain_name(function.trim())).or_default() += count;
        }
    }
    let all: u64 = samples.values().sum();
    if all == 0 {
        return Err("perf: found no sample".to_owned());
    }
    let mut shares: Vec<(String, f64)> = samples
        .into_iter()
        .map(|(function, count)| (function, 100.0 * count as f64 / all as f64))
        .collect();
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    let small = shares.iter().position(|(_, share)| *share < LEAST).unwrap_or(shares.len());
    let rest = shares.drain(small..).map(|(_, share)| share).sum();
    shares.push(("all others".to_owned(), rest));
    let share = |(function, percent)| Share { function, percent: rounded(percent) };
    let shares = shares.into_iter().map(share).collect();
    Ok((shares, all as f64 / FREQUENCY.parse::<f64>().unwrap_or(1.0)))
}

/// Counts by function.
fn count(
    virtwall: &Path,
    arguments: &[String],
    folder: &Path,
) -> Result<BTreeMap<String, Counts>, String> {
    let output = folder.join("callgrind.out");
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--quiet", "--tool=callgrind", "--cache-sim=yes", "--branch-sim=yes"]);
    valgrind.arg(format!("--callgrind-out-file={}", output.display()));
    run(valgrind.arg(virtwall).args(arguments), PACKAGES)?;
    let text = std::fs::read_to_string(&output).map_err(|error| error.to_string())?;
    let mut counts: BTreeMap<String, Counts> = BTreeMap::new();
    for (function, more) in callgrind::read(&text) {
        let sum = counts.entry(plain_name(&function)).or_default();
        sum.instructions += more.instructions;
        sum.cache_misses += more.cache_misses;
        sum.wrong_branches += more.wrong_branches;
    }
    Ok(counts)
}

/// `a::b::run::run_avx2_fma_version` is `a::b::run`: valgrind knows fewer instructions than the host.
fn plain_name(function: &str) -> String {
    let name = match function.rsplit_once("::") {
        Some((name, last)) if last.ends_with("_version") => name,
        _ => function,
    };
    name.replace("_avx512_", "_").replace("_avx_", "_")
}

/// Cycles a second: of a chain of shifts and exclusive ors, each of which takes one and waits for the
/// last (Marsaglia's xorshift64).
fn clock() -> f64 {
    const STEPS: u64 = 100_000_000;
    let (_, seconds) = timed(|| {
        let step = |mut x: u64, _| {
            x ^= x << 13;
            x ^= x >> 7;
            x ^ x << 17
        };
        black_box((0..STEPS).fold(black_box(1996), step))
    });
    6.0 * STEPS as f64 / seconds
}

/// What was found, for people.
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

#[cfg(test)]
mod tests {
    use super::plain_name;

    #[test]
    fn versions_of_a_function_have_its_name() {
        for name in ["a::walk::run::run_avx2_fma_version", "a::walk::run"] {
            assert_eq!(plain_name(name), "a::walk::run");
        }
        assert_eq!(plain_name("__memmove_avx512_unaligned_erms"), "__memmove_unaligned_erms");
        assert_eq!(plain_name("__memmove_avx_unaligned_erms"), "__memmove_unaligned_erms");
    }
}
