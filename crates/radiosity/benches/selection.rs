//! Choosing the best of many patches: the tree of greatest values against a search through all.

#![allow(missing_docs, reason = "a benchmark has no users")]

use divan::{Bencher, black_box};
use radiosity::Greatest;

/// Patches of a node of the Office and the Building on 56 processors, of the Building on one, and
/// of the paper's goal.
const PATCHES: [u32; 4] = [133, 1_278, 71_545, 1_000_000];

fn main() {
    divan::main();
}

/// Values without order, all positive.
fn values(patches: u32) -> impl ExactSizeIterator<Item = f64> {
    (0..patches).map(|i| f64::from(i.wrapping_mul(2_654_435_761) | 1))
}

/// Choose the best, and let it have shot.
#[divan::bench(args = PATCHES)]
fn tree(bencher: Bencher, patches: u32) {
    let mut energies = Greatest::new(values(patches));
    bencher.bench_local(|| {
        let best = energies.best();
        if let Some((energy, patch)) = best {
            // So that there is always a positive one, and always another that is best.
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
