//! Shots kept, archived, and cast ahead on other threads: none of it changes a run.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use common::{paragon, rules, same, two_rooms_cut};
use virtwall::{
    Archive, Helpers, KeptShots, Memory, Outcome, Rules, Run, ShotCounts, ShotKey, Source, simulate,
};

/// Shots on the simulated Paragon, 4 processors, by `kept`.
fn outcome(kept: &Arc<KeptShots>, rules: Rules) -> Outcome {
    let problem = two_rooms_cut([4, 2, 1]);
    let run =
        Run { problem, processors: 4, rules, kept: Arc::clone(kept), on_shot: Arc::new(|_| ()) };
    simulate(&run, &paragon()).unwrap()
}

fn shots(outcome: &Outcome) -> u64 {
    outcome.counts.local_shots + outcome.counts.received_shots
}

/// The same with so many threads in all, those without a run helping.
fn helped(memory: usize, threads: usize, rules: &Rules) -> (Outcome, ShotCounts) {
    let helpers = Arc::new(Helpers::of(threads));
    let kept = Arc::new(KeptShots::sharing(&Arc::new(Memory::new(memory)), &helpers, None));
    let outcome = std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(|| helpers.work_then_help(|| ()));
        }
        helpers.work_then_help(|| outcome(&kept, rules.clone()))
    });
    (outcome, kept.counts())
}

/// The same to the bit with 1, 2 and 4 threads, with room for shots and without, under rules that make
/// the run shoot all that was foreseen and under rules that do not.
#[test]
fn helpers_change_nothing() {
    for rules in [
        rules(),
        Rules { merge_masks: true, ..rules() },
        Rules { patch_threshold: 0.0, energy_threshold: 0.3, ..rules() },
    ] {
        let alone = outcome(&Arc::new(KeptShots::new(0)), rules.clone());
        for (threads, memory) in [(1, 1 << 30), (2, 1 << 30), (4, 1 << 30), (2, 0), (4, 20_000)] {
            let (outcome, counts) = helped(memory, threads, &rules);
            same(&outcome, &alone);
            assert_eq!(counts.asked(), shots(&alone), "{threads} threads: {counts:?}");
        }
    }
}

/// Without selection stopped and masks merged, what is cast ahead is asked for.
#[test]
fn nothing_is_cast_ahead_in_vain() {
    for memory in [1 << 30, 0] {
        let (_, counts) = helped(memory, 4, &rules());
        assert_eq!(counts.in_vain, 0, "{counts:?}");
    }
}

/// An archive in memory.
#[derive(Clone, Default)]
struct Shared(Arc<Mutex<BTreeMap<ShotKey, Vec<u8>>>>);

impl Archive for Shared {
    fn find(&self, key: &ShotKey) -> Option<Vec<u8>> {
        self.0.lock().unwrap().get(key).cloned()
    }

    fn put(&self, key: &ShotKey, code: &[u8]) {
        self.0.lock().unwrap().insert(*key, code.to_vec());
    }
}

fn archived(archive: &Shared, memory: usize) -> Arc<KeptShots> {
    let memory = Arc::new(Memory::new(memory));
    Arc::new(KeptShots::sharing(&memory, &Arc::default(), Some(Box::new(archive.clone()))))
}

/// Sooner or later more shots have been cast than asked for: the run gives its helper time after each.
#[test]
fn shots_are_cast_ahead() {
    let (archive, helpers) = (Shared::default(), Arc::new(Helpers::of(2)));
    let memory = Arc::new(Memory::new(1 << 30));
    let kept = KeptShots::sharing(&memory, &helpers, Some(Box::new(archive.clone())));
    let (asked, ahead) = (AtomicUsize::new(0), Arc::new(AtomicBool::new(false)));
    let seen = Arc::clone(&ahead);
    let on_shot = Arc::new(move |_: &Source| {
        let asked = asked.fetch_add(1, Relaxed) + 1;
        if !seen.load(Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
            seen.store(archive.0.lock().unwrap().len() > asked, Relaxed);
        }
    });
    let (problem, kept) = (two_rooms_cut([4, 2, 1]), Arc::new(kept));
    let run = Run { problem, processors: 4, rules: rules(), kept, on_shot };
    std::thread::scope(|scope| {
        scope.spawn(|| helpers.work_then_help(|| ()));
        helpers.work_then_help(|| simulate(&run, &paragon()).unwrap());
    });
    assert!(ahead.load(Relaxed));
}

/// What an archive holds is cast once for all runs; without room in memory it is found there each time.
#[test]
fn an_archive_outlives_the_run() {
    let alone = outcome(&Arc::new(KeptShots::new(0)), rules());
    let archive = Shared::default();
    let count = |memory| {
        let kept = archived(&archive, memory);
        same(&outcome(&kept, rules()), &alone);
        same(&outcome(&kept, rules()), &alone);
        kept.counts()
    };
    let none = ShotCounts::default();
    let first = count(1 << 30);
    let (asked, cast) = (2 * shots(&alone), archive.0.lock().unwrap().len() as u64);
    assert!(cast <= asked / 2);
    assert_eq!(first, ShotCounts { cast, in_memory: asked - cast, ..none });
    assert_eq!(count(1 << 30), ShotCounts { archived: cast, in_memory: asked - cast, ..none });
    assert_eq!(count(0), ShotCounts { archived: asked, ..none });
}

/// An archive that panics, once.
struct Faulty(AtomicBool);

impl Archive for Faulty {
    fn find(&self, _: &ShotKey) -> Option<Vec<u8>> {
        assert!(self.0.swap(true, Relaxed), "as it should");
        None
    }

    fn put(&self, _: &ShotKey, _: &[u8]) {}
}

/// A shot that a thread gave up is cast by the next that asks for it.
#[test]
fn a_panic_leaves_nothing_waiting() {
    let faulty = Box::new(Faulty(AtomicBool::new(false)));
    let kept = KeptShots::sharing(&Arc::new(Memory::new(1 << 20)), &Arc::default(), Some(faulty));
    let kept = Arc::new(kept);
    assert!(catch_unwind(AssertUnwindSafe(|| outcome(&kept, rules()))).is_err());
    same(&outcome(&kept, rules()), &outcome(&Arc::new(KeptShots::new(0)), rules()));
}

/// Bytes that cannot be a shot of their environment are cast anew: too few, too many, another's.
#[test]
fn what_is_no_shot_is_cast_anew() {
    let alone = outcome(&Arc::new(KeptShots::new(0)), rules());
    let whole = Shared::default();
    outcome(&archived(&whole, 0), rules());
    let spoil: [fn(usize, &mut Vec<u8>); 5] = [
        |i, code| code.truncate(i % code.len()),
        |_, code| code.push(0),
        // Many hits; a patch that does not exist; a neighbour that does not.
        |_, code| code[104..108].fill(0xff),
        |_, code| code[108..112].fill(0xff),
        |_, code| *code.last_mut().unwrap() ^= 1,
    ];
    for (i, spoil) in spoil.into_iter().enumerate() {
        let spoiled = Shared(Arc::new(Mutex::new(whole.0.lock().unwrap().clone())));
        for (place, code) in spoiled.0.lock().unwrap().values_mut().enumerate() {
            spoil(place * 37, code);
        }
        let kept = archived(&spoiled, 1 << 30);
        same(&outcome(&kept, rules()), &alone);
        assert_eq!(kept.counts().cast, whole.0.lock().unwrap().len() as u64, "{i}");
    }
}
