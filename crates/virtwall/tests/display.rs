//! The way to the display and the start-up: what they cost a run, and nothing else.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::collections::BTreeMap;
use std::sync::Arc;

use common::{paragon, rules, same, two_rooms_cut};
use desim::{Duration, Time};
use multicomputer::{Display, Ethernet, StartUp, WhenFull};
use virtwall::{KeptShots, Outcome, Run, RunError, simulate, start_up};

fn run(processors: usize) -> Run {
    Run {
        problem: two_rooms_cut([4, 2, 1]),
        processors,
        rules: rules(),
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    }
}

fn span(seconds: f64) -> Duration {
    Duration::from_seconds_f64(seconds)
}

/// A display as fast as it can be made, with room for a few updates.
fn ample() -> Display {
    Display {
        frame_time: Duration::ZERO,
        copy_bandwidth: 1e12,
        service_buffers: 10_000,
        when_full: WhenFull::BackPressure,
        ethernet: Ethernet { bandwidth: 1e12, payload: 1_460, overhead: 78 },
        window: 10_000,
        update_time: Duration::ZERO,
    }
}

/// One that takes a second an update, of which nodes make dozens a second.
fn slow(when_full: WhenFull) -> Display {
    Display { update_time: span(1.0), when_full, window: 1_000, ..ample() }
}

fn on(run: &Run, display: Option<Display>) -> Outcome {
    let mut machine = paragon();
    machine.display = display;
    simulate(run, &machine).unwrap()
}

#[test]
fn a_fast_display_costs_nothing() {
    for processors in [1, 3, 8] {
        let without = on(&run(processors), None);
        assert_eq!(without.display, None);
        let mut with = on(&run(processors), Some(ample()));
        let report = with.display.take().unwrap();
        same(&with, &without);
        assert_eq!((report.shown, report.dropped), (with.counts.update_messages, 0));
        assert!(report.lag < span(0.001) && report.waiting == Duration::ZERO);
    }
}

#[test]
fn compute_nodes_wait_for_a_slow_display() {
    for processors in [1, 8] {
        let free = on(&run(processors), None);
        let held = on(&run(processors), Some(slow(WhenFull::BackPressure)));
        let report = held.display.unwrap();
        assert_eq!((report.shown, report.dropped), (held.counts.update_messages, 0));
        assert!(held.time > free.time && report.waiting > Duration::ZERO);
        // The display is the slowest part: it shows an update every second from first to last.
        let all = (held.time - Time::ZERO + report.lag).as_seconds_f64();
        assert!((report.consumer_busy - report.shown as f64 / all).abs() < 1e-9);
        assert!(report.consumer_busy > 0.95, "{}", report.consumer_busy);
        for node in &held.nodes {
            assert!(node.compute + node.overhead + node.idle <= held.time - Time::ZERO);
        }
        if processors == 1 {
            assert_eq!(held.radiosity, free.radiosity);
        }
        same(&held, &on(&run(processors), Some(slow(WhenFull::BackPressure))));
    }
}

#[test]
fn a_slow_display_that_drops_updates_holds_nobody_up() {
    for when_full in [WhenFull::DropOldest, WhenFull::DropNewest] {
        let free = on(&run(8), None);
        let mut dropping = on(&run(8), Some(slow(when_full)));
        let report = dropping.display.take().unwrap();
        assert_eq!(report.shown + report.dropped, dropping.counts.update_messages);
        assert!(report.dropped > 0 && report.waiting == Duration::ZERO);
        assert_eq!(dropping.counts.local_shots, free.counts.local_shots);
        // The service node reads its mail at other times, and so do its orders come.
        let apart = dropping.time.as_seconds_f64() / free.time.as_seconds_f64() - 1.0;
        assert!(apart.abs() < 0.01, "{apart}");
    }
}

/// A microsecond a byte, 1,000 bytes at a time, and so many cycles of 20 ns a step.
fn disks() -> StartUp {
    let cycles = [("polygon_read", 100.0), ("polygon_cut", 10.0), ("patch_made", 1.0)];
    StartUp {
        io_nodes: 1,
        bandwidth: 1e6,
        access_time: Duration::ZERO,
        request: 1_000,
        cycles: cycles.map(|(name, cycles)| (name.to_owned(), cycles)).into(),
    }
}

#[test]
fn a_start_up_is_reading_and_making_ready() {
    let mut machine = paragon();
    machine.processor.scale = 1.0;
    assert_eq!(start_up(&run(1), &machine, 5_000).unwrap(), None);
    machine.start_up = Some(disks());
    let run = run(1);
    let alone = start_up(&run, &machine, 5_000).unwrap().unwrap();
    let polygons = run.problem.space.scene.polygons.len() as f64;
    let pieces: usize = run.problem.environments.iter().map(|e| e.polygons()).sum();
    let cycles = 100.0 * polygons + 10.0 * pieces as f64 + run.problem.patches() as f64;
    assert_eq!((alone.reading, alone.disk_wait), (span(0.005), Duration::ZERO));
    assert_eq!(alone.time, span(0.005) + span(cycles / 50e6));

    let all = start_up(&Run { processors: 8, ..run }, &machine, 5_000).unwrap().unwrap();
    assert_eq!((all.reading, all.disk_wait), (span(0.040), span(0.035)));
    // Every node reads all polygons, and cuts its own.
    assert!(all.time - all.reading > span(100.0 * polygons / 50e6));
    assert!(all.time - all.reading < alone.time - alone.reading);
}

#[test]
fn a_step_without_a_price_is_refused() {
    let mut machine = paragon();
    machine.start_up = Some(StartUp { cycles: BTreeMap::new(), ..disks() });
    let refused = start_up(&run(1), &machine, 1);
    let Err(RunError::Missing { name, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(name, "polygon_read");
}
