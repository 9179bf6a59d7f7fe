//! Rungs of the ladder of networks, by messages a second of the host.

#![allow(missing_docs, reason = "a benchmark has no users")]

mod exchange;

use divan::Bencher;
use divan::counter::ItemsCount;
use multicomputer::NetworkModel;

/// Messages of a round: 56 nodes × 4 neighbours.
const ROUNDS: u64 = 100;

fn main() {
    divan::main();
}

/// A rung by its name, as the table of results shows it.
struct Rung(&'static str, NetworkModel);

impl std::fmt::Display for Rung {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0)
    }
}

#[divan::bench(args = exchange::rungs().into_iter().map(|(name, model)| Rung(name, model)))]
fn network(bencher: Bencher, rung: &Rung) {
    let messages = (exchange::COLUMNS * exchange::ROWS * 4) as u64 * ROUNDS;
    bencher.counter(ItemsCount::new(messages)).bench(|| exchange::exchange(&rung.1, ROUNDS));
}
