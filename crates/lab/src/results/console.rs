//! The results in the layout of the paper's Table 1, and as text for a terminal.

use std::collections::{BTreeMap, BTreeSet};

use crate::results::summary::{Summary, group, ratio};
use crate::table::runs_csv::Table;

/// One line of the table: a run and its published figures.
pub struct Line {
    /// What the lines of a group share: the scene, and the values of other swept fields.
    pub group: String,
    pub processors: String,
    /// Simulated seconds and speed-up.
    pub simulated: [String; 2],
    /// Published seconds and speed-up.
    pub paper: [String; 2],
    /// Simulated over published speed-up; on one processor, where the speed-up is 1 by definition,
    /// "t" and simulated over published time.
    pub ratio: String,
    /// How the run ended, if it failed or ended too early.
    pub note: String,
}

/// The results, line by line, those of a group together, in the order of the groups' first lines.
pub fn lines(table: &Table, sweeps: &[String]) -> Vec<Line> {
    let mut lines: Vec<Line> = table.rows.iter().map(|row| line(table, row, sweeps)).collect();
    let mut first = BTreeMap::new();
    for (i, line) in lines.iter().enumerate() {
        first.entry(line.group.clone()).or_insert(i);
    }
    lines.sort_by_key(|line| first[&line.group]);
    lines
}

fn line(table: &Table, row: &[String], sweeps: &[String]) -> Line {
    let number = |column| table.number(row, column).map_or(String::new(), digits);
    let processors = table.cell(row, "processors");
    let compared = |ours, paper| ratio(table, row, ours, paper);
    let ratio = match processors {
        "1" => compared("time_s", "paper_time_s").map(|ratio| format!("t {ratio:.2}")),
        _ => compared("speed_up", "paper_speed_up").map(|ratio| format!("{ratio:.2}")),
    };
    Line {
        group: group(table, row, sweeps),
        processors: processors.to_owned(),
        simulated: ["time_s", "speed_up"].map(number),
        paper: ["paper_time_s", "paper_speed_up"].map(number),
        ratio: ratio.unwrap_or_default(),
        note: match table.cell(row, "ending") {
            "failed" => format!("failed: {}", table.cell(row, "failure")),
            "too_early" => "ended too early".to_owned(),
            _ => String::new(),
        },
    }
}

/// The results as text: lines under the name of their group, and the summary. Speed-ups are over `base`
/// processors.
pub fn table_text(table: &Table, sweeps: &[String], base: u64) -> String {
    let lines = lines(table, sweeps);
    let compared = lines.iter().any(|line| !line.paper.concat().is_empty());
    let mut text = String::new();
    let mut add = |line: String| {
        text += line.trim_end();
        text += "\n";
    };
    if compared {
        add(format!("{:>9}{:>22}{:>24}", "", "simulated", "paper"));
        add(columns("procs", ["time s", "speed-up"], ["time s", "speed-up"], "ratio"));
    } else {
        add(columns("procs", ["time s", "speed-up"], ["", ""], ""));
    }
    let mut group = None;
    for line in &lines {
        if group != Some(&line.group) {
            add(line.group.clone());
            group = Some(&line.group);
        }
        let [simulated, paper] =
            [&line.simulated, &line.paper].map(|cells| cells.each_ref().map(String::as_str));
        let cells = columns(&line.processors, simulated, paper, &line.ratio);
        add(format!("{cells}  {}", line.note));
    }
    for sentence in Summary::of(table, sweeps).lines() {
        add(format!("\n{sentence}"));
    }
    if let Some(sentence) = without_base(table, sweeps, base) {
        add(format!("\n{sentence}"));
    }
    text
}

/// Which groups have times but no run on `base` processors, which speed-ups are relative to.
fn without_base(table: &Table, sweeps: &[String], base: u64) -> Option<String> {
    let timed = || table.rows.iter().filter(|row| table.number(row, "time_s").is_some());
    let on_base = |row: &&Vec<String>| table.cell(row, "processors") == base.to_string();
    let based: BTreeSet<String> =
        timed().filter(on_base).map(|row| group(table, row, sweeps)).collect();
    let mut groups: Vec<String> = timed().map(|row| group(table, row, sweeps)).collect();
    groups.retain(|group| !based.contains(group));
    groups.dedup();
    let (first, plural) = (groups.first()?, if base == 1 { "" } else { "s" });
    let others = match groups.len() - 1 {
        0 => String::new(),
        others => format!(" and {others} more"),
    };
    Some(format!(
        "No speed-up of {first}{others}: no run on {base} processor{plural} to compare with. Add one, or name \
         another number by \"speed_up_over\"."
    ))
}

/// A number with two decimal places, or with three digits if it is below 1.
fn digits(number: f64) -> String {
    match number.abs() {
        0.0 | 1.0.. => format!("{number:.2}"),
        small if small < 1e-4 => format!("{number:.2e}"),
        small => format!("{number:.0$}", (2 - small.log10().floor() as i32) as usize),
    }
}

fn columns(processors: &str, simulated: [&str; 2], paper: [&str; 2], ratio: &str) -> String {
    let ([time, speed_up], [paper_time, paper_speed_up]) = (simulated, paper);
    format!("{processors:>9}{time:>12}{speed_up:>10}{paper_time:>14}{paper_speed_up:>10}{ratio:>9}")
}
