//! Counts of valgrind for a program, function by function.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::command;
use crate::function::plain_name;

/// Counts of a function, without the functions that it calls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    pub instructions: u64,
    /// Loads and stores that miss the first cache.
    pub cache_misses: u64,
    /// Conditional or indirect branches that a simple predictor mispredicts.
    pub wrong_branches: u64,
}

pub fn count(
    virtwall: &Path,
    arguments: &[String],
    folder: &Path,
) -> Result<BTreeMap<String, Counts>, String> {
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--branch-sim=yes");
    Ok(read(&run(valgrind, virtwall, arguments, folder)?))
}

/// Runs a program in callgrind, with more options given in `valgrind`; returns callgrind's output.
pub fn run(
    mut valgrind: Command,
    program: &Path,
    arguments: &[String],
    folder: &Path,
) -> Result<String, String> {
    let output = folder.join("callgrind.out");
    valgrind.args(["--quiet", "--tool=callgrind", "--cache-sim=yes"]);
    valgrind.arg(format!("--callgrind-out-file={}", output.display()));
    command::run(valgrind.arg(program).args(arguments), "valgrind")?;
    std::fs::read_to_string(&output).map_err(|error| error.to_string())
}

/// Reads callgrind's output: counts by name of function.
fn read(text: &str) -> BTreeMap<String, Counts> {
    let mut names: BTreeMap<&str, &str> = BTreeMap::new();
    let mut counts: BTreeMap<String, Counts> = BTreeMap::new();
    let mut events: Vec<&str> = Vec::new();
    let (mut function, mut called) = ("", false);
    for line in text.lines() {
        if let Some(list) = line.strip_prefix("events: ") {
            events = list.split(' ').collect();
        } else if let Some(name) = line.strip_prefix("fn=") {
            function = named(name, &mut names);
        } else if let Some(name) = line.strip_prefix("cfn=") {
            named(name, &mut names);
        } else if line.starts_with("calls=") {
            called = true;
        } else if line.starts_with(|c: char| c.is_ascii_digit() || "+-*".contains(c)) {
            // The line after a call has the counts of the called function.
            if !std::mem::take(&mut called) {
                add(counts.entry(plain_name(function)).or_default(), &events, line);
            }
        }
    }
    counts
}

/// `(7) name` gives number 7 a name; later `(7)` stands for that name.
fn named<'a>(text: &'a str, names: &mut BTreeMap<&'a str, &'a str>) -> &'a str {
    let (number, name) = text.split_once(' ').unwrap_or((text, ""));
    if !name.is_empty() {
        names.insert(number, name);
    }
    names.get(number).copied().unwrap_or(number)
}

/// A line: the position, then a count for each event; zeros at the end are left out.
fn add(counts: &mut Counts, events: &[&str], line: &str) {
    for (event, count) in events.iter().zip(line.split(' ').skip(1)) {
        let count = count.parse().unwrap_or(0);
        match *event {
            "Ir" => counts.instructions += count,
            "D1mr" | "D1mw" => counts.cache_misses += count,
            "Bcm" | "Bim" => counts.wrong_branches += count,
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_called_functions_are_not_included() {
        let text = "events: Ir D1mr D1mw Bcm\n\nfl=(1) a.rs\nfn=(1) outer\n10 5 1\n\
                    cfn=(2) inner\ncalls=3 7\n11 900 1 1 1\n+1 2 0 1 4\nfn=(2)\n7 30\nfn=(1)\n* 1\n";
        let counts = read(text);
        let outer = Counts { instructions: 8, cache_misses: 2, wrong_branches: 4 };
        assert_eq!(counts["outer"], outer);
        assert_eq!(counts["inner"], Counts { instructions: 30, ..Counts::default() });
        assert_eq!(counts.len(), 2);
    }
}
