//! Speed of the network models: messages a second of the host's time.

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

#[divan::bench(args = exchange::OURS)]
fn network(bencher: Bencher, model: NetworkModel) {
    let messages = (exchange::COLUMNS * exchange::ROWS * 4) as u64 * ROUNDS;
    bencher.counter(ItemsCount::new(messages)).bench(|| exchange::exchange(model, ROUNDS));
}
