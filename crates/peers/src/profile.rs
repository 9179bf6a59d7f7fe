//! Where the time goes: what perf samples and valgrind counts, function by function.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Serialize;
use tempfile::TempDir;

use crate::callgrind::{self, Counts};
use crate::command::{cargo, run};
use crate::cpu::{rounded, timed};

/// Functions with less of the time than this many per cent are told together.
const LEAST: f64 = 1.0;

/// Sources of the kernel's profile, sampled and counted: a second, and a few under valgrind.
const SAMPLED: u64 = 1_024;
const COUNTED: u64 = 32;
const RAYS: u64 = 30_976;

/// Packages of Debian with what looks.
const PACKAGES: &str = "linux-perf valgrind";

/// The commands that are looked at.
const TABLE1: &[&str] = &["run", "experiments/table1.json", "--threads", "1", "--out"];
const KERNEL: &[&str] = &["bench", "rays", "rooms", "--rays", "30976", "--sources"];

/// A function and its own part of the time.
#[derive(Serialize)]
pub struct Share {
    /// The function, whatever processor it is compiled for.
    pub function: String,
    /// Per cent of the samples.
    pub percent: f64,
}

/// A function of the kernel, by ray.
#[derive(Serialize)]
pub struct Part {
    /// As in [`Share`].
    pub function: String,
    /// As in [`Share`].
    pub percent: f64,
    /// Cycles of the processor.
    pub cycles: f64,
    /// Instructions, of which valgrind knows no wider vectors than AVX2's.
    pub instructions: f64,
    /// Loads and stores that miss the first cache.
    pub cache_misses: f64,
    /// Branches that are guessed wrong.
    pub wrong_branches: f64,
    /// The limit that accounts for most of the cycles.
    pub limit: &'static str,
    /// The cycles that it accounts for, per cent.
    pub limit_percent: f64,
}

/// What processors of today can do at best, assumed: instructions a cycle, cycles until a line comes
/// from the second cache, cycles until work goes on after a wrong branch. Intel's Golden Cove has
/// 6, 14 and 17.
const LIMITS: [(&str, f64); 3] =
    [("instructions", 1.0 / 6.0), ("second cache's latency", 14.0), ("wrong branches", 17.0)];

impl Part {
    fn new(share: Share, cycles: f64, counts: Counts, rays: f64) -> Part {
        let Counts { instructions, cache_misses, wrong_branches } = counts;
        let [i, m, w] = [instructions, cache_misses, wrong_branches].map(|n| n as f64 / rays);
        let costs = [i, m, w].into_iter().zip(LIMITS).map(|(n, (limit, cost))| (limit, n * cost));
        let (limit, least) =
            costs.reduce(|a, b| if b.1 > a.1 { b } else { a }).unwrap_or(("", 0.0));
        Part {
            function: share.function,
            percent: share.percent,
            cycles: rounded(cycles),
            instructions: rounded(i),
            cache_misses: rounded(m),
            wrong_branches: rounded(w),
            limit: if least > 0.0 { limit } else { "" },
            limit_percent: rounded(100.0 * least / cycles),
        }
    }
}

/// What was found.
pub struct Profile {
    /// Functions of Table 1's whole run, the greatest share first.
    pub table1: Vec<Share>,
    /// Those of the kernel on the rooms.
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
    let out = folder.join("table1").display().to_string();
    let (table1, _) = sample(&virtwall, TABLE1, &out, folder)?;
    let (shares, seconds) = sample(&virtwall, KERNEL, &SAMPLED.to_string(), folder)?;
    let counts = count(&virtwall, KERNEL, &COUNTED.to_string(), folder)?;
    let clock = clock();
    let cycles_a_ray = seconds * clock / (SAMPLED * RAYS) as f64;
    let part = |share: Share| {
        let counts = counts.get(&share.function).copied().unwrap_or_default();
        let cycles = cycles_a_ray * share.percent / 100.0;
        Part::new(share, cycles, counts, (COUNTED * RAYS) as f64)
    };
    Ok(Profile { table1, kernel: shares.into_iter().map(part).collect(), clock })
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
    arguments: &[&str],
    last: &str,
    folder: &Path,
) -> Result<(Vec<Share>, f64), String> {
    let data = folder.join("perf.data");
    // The clock is there in virtual machines too, where the processor's counters often are not.
    let mut perf = Command::new("perf");
    perf.args(["record", "--quiet", "-e", "cpu-clock:u", "-F", "1999", "-o"]).arg(&data);
    run(perf.arg("--").arg(virtwall).args(arguments).arg(last), PACKAGES)?;
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
    Ok((shares, all as f64 / 1999.0))
}

/// Counts by function.
fn count(
    virtwall: &Path,
    arguments: &[&str],
    last: &str,
    folder: &Path,
) -> Result<BTreeMap<String, Counts>, String> {
    let output = folder.join("callgrind.out");
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--quiet", "--tool=callgrind", "--cache-sim=yes", "--branch-sim=yes"]);
    valgrind.arg(format!("--callgrind-out-file={}", output.display()));
    run(valgrind.arg(virtwall).args(arguments).arg(last), PACKAGES)?;
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

/// Both profiles, for people.
pub fn table(profile: &Profile) -> String {
    let mut text = String::from("\n| Table 1, one thread | % of the time |\n|---|---:|\n");
    let mut put = |line: String| {
        writeln!(text, "{line}").expect("writing to a String does not fail");
    };
    for Share { function, percent } in &profile.table1 {
        put(format!("| `{function}` | {percent:.1} |"));
    }
    put(format!(
        "\n| kernel on the rooms, a ray | % of the time | cycles at {:.2} GHz | instructions | \
         cache misses | wrong branches | nearest limit | % of cycles |\n\
         |---|---:|---:|---:|---:|---:|---|---:|",
        profile.clock / 1e9
    ));
    for part in &profile.kernel {
        let Part { function, percent, cycles, instructions, limit, limit_percent, .. } = part;
        let (misses, branches) = (part.cache_misses, part.wrong_branches);
        put(format!(
            "| `{function}` | {percent:.1} | {cycles:.1} | {instructions:.1} | {misses:.2} | \
             {branches:.2} | {limit} | {limit_percent:.0} |"
        ));
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
