//! Mutated files of all kinds: each is valid or refused with one message, and nothing panics.
//!
//! `tests/corpus` has inputs on which the program once failed. `MUTANTS=100000` makes more mutants than the
//! usual test run, `MUTANTS_SEED=7` others.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use common::{Project, SWEEP};
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Mutants of a usual test run.
const MUTANTS: u64 = 20_000;

/// Texts that replace numbers.
const NUMBERS: [&str; 14] = [
    "0",
    "-0",
    "-1",
    "1e308",
    "1e-320",
    "1e999",
    "nan",
    "inf",
    "0.3",
    "7",
    "4294967296",
    "18446744073709551616",
    "",
    "\"",
];

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

/// The files of the corpus, by name, and a schedule and a table of messages.
fn corpus() -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .collect();
    files.sort();
    let goal = "num_ranks 2\nrank 0 {\na: calc 1000\nb: send 4096b to 1\nb requires a\n}\n";
    files.push(("t.goal".to_owned(), goal.into()));
    files.push(("t.csv".to_owned(), "time,source,destination,bytes\n1 us,0,1,4096\n".into()));
    files
}

/// Start and end of a word, at a random place.
fn word(text: &[u8], random: &mut ChaCha8Rng) -> (usize, usize) {
    let at = random.random_range(0..text.len());
    let apart = |&byte: &u8| byte.is_ascii_whitespace() || b"\",:[]{}".contains(&byte);
    let start = text[..at].iter().rposition(apart).map_or(0, |before| before + 1);
    let end = text[at..].iter().position(apart).map_or(text.len(), |after| at + after);
    (start, end.max(start))
}

/// Changes a text at one place.
fn mutate(text: &mut Vec<u8>, others: &[(String, Vec<u8>)], random: &mut ChaCha8Rng) {
    if text.is_empty() {
        return;
    }
    let (start, end) = word(text, random);
    match random.random_range(0..6) {
        0 => text[start.min(end.saturating_sub(1))] = random.random(),
        1 => drop(text.drain(start..end)),
        2 => {
            let copy = text[start..end].to_vec();
            drop(text.splice(start..start, copy));
        }
        3 => {
            let (_, other) = others.choose(random).unwrap();
            let (from, to) = word(other, random);
            drop(text.splice(start..end, other[from..to].iter().copied()));
        }
        4 => text.truncate(start),
        _ => drop(text.splice(start..end, NUMBERS.choose(random).unwrap().bytes())),
    }
}

#[test]
fn mutants_are_valid_or_refused_with_one_message() {
    let (project, corpus) = (Project::new(SWEEP), corpus());
    for (name, text) in &corpus {
        fs::write(project.path(&format!("experiments/{name}")), text).unwrap();
    }
    let seed = number("MUTANTS_SEED", 1996);
    let (mut valid, mut refused) = (0, 0);
    for round in 0..number("MUTANTS", MUTANTS) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(round);
        let (name, text) = corpus.choose(&mut random).unwrap();
        let mut mutant = text.clone();
        for _ in 0..random.random_range(1..4) {
            mutate(&mut mutant, &corpus, &mut random);
        }
        let path = project.path(&format!("experiments/mutant-{name}"));
        fs::write(&path, &mutant).unwrap();
        let checked = catch_unwind(AssertUnwindSafe(|| lab::check(&path)));
        let of = || format!("round {round}, {name}:\n{}", String::from_utf8_lossy(&mutant));
        match checked.unwrap_or_else(|_| panic!("{}", of())) {
            Ok(checked) => {
                valid += 1;
                assert!(!checked.what.is_empty(), "{}", of());
            }
            Err(fault) => {
                refused += 1;
                let message = fault.to_string();
                let one_line = !message.is_empty() && !message.contains(['\n', '\r']);
                assert!(one_line, "{message}\n{}", of());
            }
        }
        fs::remove_file(&path).unwrap();
    }
    assert!(valid > 0 && refused > 0, "{valid} valid, {refused} refused");
}
