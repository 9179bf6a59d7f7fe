//! The time of a program by function, sampled by perf.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use serde::Serialize;

use crate::command::run;
use crate::cpu::rounded;
use crate::function::plain_name;

/// Functions below this share of the time, in per cent, are summed.
const LEAST: f64 = 1.5;

/// Samples a second.
const FREQUENCY: &str = "5000";

/// A function and its own share of the time.
#[derive(Serialize)]
pub struct Share {
    /// The function; versions for different processors have one name.
    pub function: String,
    /// Per cent of the samples.
    pub percent: f64,
}

/// Shares of the time by function, and processor seconds sampled.
pub fn sample(
    virtwall: &Path,
    arguments: &[String],
    folder: &Path,
) -> Result<(Vec<Share>, f64), String> {
    let data = folder.join("perf.data");
    // Virtual machines often have no hardware counters, but always a clock.
    let mut perf = Command::new("perf");
    perf.args(["record", "--quiet", "-e", "cpu-clock:u", "-F", FREQUENCY, "-o"]).arg(&data);
    run(perf.arg("--").arg(virtwall).args(arguments), "linux-perf")?;
    let mut perf = Command::new("perf");
    perf.args(["report", "--stdio", "--no-children", "-F", "sample,symbol", "-i"]).arg(&data);
    let report = run(&mut perf, "linux-perf")?;
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
    let percent = |count: u64| 100.0 * count as f64 / all as f64;
    let share = |(function, count)| Share { function, percent: percent(count) };
    let mut shares: Vec<Share> = samples.into_iter().map(share).collect();
    shares.sort_by(|a, b| b.percent.total_cmp(&a.percent));
    let small = shares.partition_point(|share| share.percent >= LEAST);
    let percent = shares.drain(small..).map(|share| share.percent).sum();
    shares.push(Share { function: "all others".to_owned(), percent });
    shares.iter_mut().for_each(|share| share.percent = rounded(share.percent));
    Ok((shares, all as f64 / FREQUENCY.parse::<f64>().unwrap_or(1.0)))
}
