//! Benchmark of the choice of the best of many patches: a tournament tree and a search through all.

#![allow(missing_docs, reason = "a benchmark has no users")]

use divan::{Bencher, black_box};
use radiosity::Greatest;

/// Patches of a node: of Office and Building on 56 processors, of Building on one, and of the size
/// that the paper aims at.
const PATCHES: [u32; 4] = [133, 1_278, 71_545, 1_000_000];

fn main() {
    divan::main();
}

/// Positive values in pseudo-random order.
fn values(patches: u32) -> impl ExactSizeIterator<Item = f64> {
    (0..patches).map(|i| f64::from(i.wrapping_mul(2_654_435_761) | 1))
}

/// Chooses the best value and halves it.
#[divan::bench(args = PATCHES)]
fn tree(bencher: Bencher, patches: u32) {
    let mut energies = Greatest::new(values(patches));
    bencher.bench_local(|| {
        let best = energies.best();
        if let Some((energy, patch)) = best {
            // All values stay positive, and the best one changes.
            energies.set(patch, energy * 0.5);
        }
        best
    });
}

/// The same by a search through all.
#[divan::bench(args = PATCHES)]
fn search(bencher: Bencher, patches: u32) {
    let mut energies: Vec<f64> = values(patches).collect();
    bencher.bench_local(|| {
        let all = black_box(&energies).iter().copied().zip(0_u32..);
        let best = all.reduce(|best, other| if other.0 > best.0 { other } else { best });
        if let Some((energy, patch)) = best {
            energies[patch as usize] = energy * 0.5;
        }
        best
    });
}
