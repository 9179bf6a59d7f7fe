//! Observed runs: nothing is changed, nothing is missing, and the light comes back at any instant.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use common::{paragon, rules, same, two_rooms_cut};
use desim::{Duration, Time};
use multicomputer::{LayerAccount, Machine, MessageLayer, NodeMemory, Packets};
use radiosity::Rgb;
use virtwall::{
    Activity, Instant, KeptShots, MessageKind, MessageRecord, Outcome, Recording, Rules, Run,
    Shooting, SourceSplit, Thing, simulate, simulate_observed, visit_instants, visit_stops,
};

fn run(processors: usize, rules: Rules) -> Run {
    Run {
        problem: two_rooms_cut([4, 2, 1]),
        processors,
        rules,
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    }
}

fn record(run: &Run, machine: &Machine) -> (Outcome, Recording) {
    let recording = Rc::new(RefCell::new(Recording::new(&run.problem, run.processors)));
    let observer = Some(recording.clone() as _);
    let outcome = simulate_observed(run, machine, machine.network(), observer).unwrap();
    (outcome, recording.take())
}

/// Machines that do everything that a machine can do.
fn machines() -> [Machine; 4] {
    let plain = paragon();
    let mut ideal = paragon();
    ideal.network_model = Some(multicomputer::NetworkModel::Ideal);
    let packets = Packets { bytes: 1_024, time: Duration::from_seconds_f64(1e-4) };
    let layer = MessageLayer {
        packets: Some(packets),
        handover: None,
        copy_bandwidth: Some(1e7),
        buffer_bytes: Some(2_000),
    };
    let mut full = paragon();
    full.message_layer = layer.clone();
    full.node_memory = Some(NodeMemory {
        available: 60_000,
        message_buffers: 10_000,
        burst: 8_192,
        fault_time: Duration::from_seconds_f64(0.018),
        bandwidth: 3e6,
        sizes: Thing::ALL.map(|(_, name)| (name.to_owned(), 100)).into(),
    });
    let mut coprocessor = paragon();
    let handover = Some(Duration::from_seconds_f64(1e-5));
    coprocessor.message_layer = MessageLayer { handover, ..layer };
    [plain, ideal, full, coprocessor]
}

/// Spans tile a node's life, and add up to its account to the picosecond.
#[test]
fn spans_are_the_account() {
    let mut layers = LayerAccount::default();
    let mut paging = Duration::ZERO;
    for machine in machines() {
        let run = run(5, rules());
        let (outcome, recording) = record(&run, &machine);
        same(&outcome, &simulate(&run, &machine).unwrap());
        assert_eq!(recording.nodes.len(), 6);
        for (node, report) in recording.nodes.iter().zip(&outcome.nodes) {
            let time = |wanted: Activity| node.time(|activity| activity == wanted);
            assert_eq!(node.time(Activity::computes), report.compute);
            assert_eq!(node.time(Activity::is_overhead), report.overhead);
            assert_eq!(time(Activity::Paging), report.paging);
            assert_eq!(time(Activity::Wait), report.idle);
            assert_eq!(time(Activity::Pack), report.layer.packing);
            assert_eq!(time(Activity::Copy), report.layer.copying);
            assert_eq!(time(Activity::WaitForRoom), report.layer.waiting_for_room);
            layers.add(&report.layer);
            paging += report.paging;
            assert_eq!(node.end(), node.spans().last().unwrap().to);
            let mut before = Time::ZERO;
            for span in node.spans() {
                assert!(span.from == before && span.to > span.from, "{span:?}");
                before = span.to;
            }
        }
        let ends = recording.nodes[..5].iter().map(|node| node.end());
        assert_eq!(ends.max(), Some(outcome.time));
    }
    let LayerAccount { packing, copying, waiting_for_room, .. } = layers;
    assert!([paging, packing, copying, waiting_for_room].iter().all(|span| span.0 > 0));
}

/// Every shot has its span, which says whose it was and ends when the shot did.
#[test]
fn shots_have_their_spans() {
    let runs = machines().map(|machine| (rules(), machine));
    for (rules, machine) in runs.into_iter().chain([(knobs(), paragon())]) {
        let (outcome, recording) = record(&run(3, rules), &machine);
        for (node, report) in recording.nodes.iter().zip(&outcome.nodes) {
            let shots = |span: &virtwall::Span| {
                matches!(span.activity, Activity::LocalShot | Activity::ReceivedShot)
            };
            let spans: Vec<_> = node.spans().filter(shots).collect();
            assert_eq!(spans.len(), node.shots.len());
            for (span, shot) in spans.iter().zip(&node.shots) {
                let local = shot.environment == shot.source_environment;
                assert_eq!(span.to, shot.at);
                assert_eq!(span.activity == Activity::LocalShot, local);
            }
            let local = spans.iter().filter(|span| span.activity == Activity::LocalShot).count();
            assert_eq!(local as u64, report.local_shots);
            assert_eq!((spans.len() - local) as u64, report.received_shots);
            let (_, last) = node.queue.last().unwrap();
            assert_eq!(*last, 0, "nothing is left in a queue");
        }
    }
}

/// Messages and their bytes are those that the run counted; each is sent, arrives and is read.
#[test]
fn messages_are_the_counts() {
    for machine in machines() {
        let (outcome, recording) = record(&run(4, rules()), &machine);
        let of = |kinds: &[MessageKind]| -> (u64, u64) {
            let asked = |m: &&MessageRecord| kinds.contains(&m.kind);
            let found = recording.messages.iter().filter(asked);
            found.fold((0, 0), |(count, bytes), m| (count + 1, bytes + u64::from(m.bytes)))
        };
        let counts = outcome.counts;
        assert!(counts.messages > 0);
        assert_eq!(of(&[MessageKind::Source]), (counts.messages, counts.message_bytes));
        assert_eq!(of(&[MessageKind::Update]), (counts.update_messages, counts.update_bytes));
        let data = [MessageKind::Source, MessageKind::Update];
        let control = recording.messages.iter().filter(|message| !data.contains(&message.kind));
        assert_eq!(control.count() as u64, counts.control_messages);
        for message in &recording.messages {
            assert!(message.arrived.unwrap() >= message.sent);
            if message.kind == MessageKind::Source {
                assert!(message.read.unwrap() >= message.arrived.unwrap(), "{message:?}");
            }
        }
        assert!(recording.messages.is_sorted_by_key(|message| message.sent));
    }
}

/// Energy closes at every change, and the last state is the outcome's.
#[test]
fn energy_closes_at_every_instant() {
    for rules in [rules(), Rules { merge_masks: true, ..rules() }, knobs()] {
        energy_closes(&run(4, rules));
    }
}

/// What RR-3008 does not do: patches cut in four, over-shooting, an ambient term.
fn knobs() -> Rules {
    let split = SourceSplit { nearer_than: f64::INFINITY, most: 2 };
    let shooting = Shooting { split, overshoot: 1.2, ambient: true };
    Rules { patch_threshold: 0.02, shooting, ..rules() }
}

fn energy_closes(run: &Run) {
    let (outcome, recording) = record(run, &paragon());
    let emitted = outcome.energy.emitted.element_sum();
    for at in &recording.energy {
        let found = at.unshot + at.in_transit + at.absorbed + at.escaped;
        assert!((found - emitted).abs() < 1e-9 * emitted, "{at:?}");
    }
    let (first, last) = (recording.energy[0], recording.energy[recording.energy.len() - 1]);
    assert_eq!((first.at, first.unshot), (Time::ZERO, emitted));
    assert!(recording.energy.is_sorted_by(|one, next| one.at < next.at));
    let energy = &outcome.energy;
    for (found, end) in [
        (last.unshot, energy.unshot),
        (last.in_transit, energy.in_transit),
        (last.absorbed, energy.absorbed),
        (last.escaped, energy.escaped),
    ] {
        assert!((found - end.element_sum()).abs() < 1e-9 * emitted, "{last:?}");
    }
}

/// Radiosity in W/m² at each of `times`, in rising order, by environment and patch.
fn radiosity_at(run: &Run, machine: &Machine, times: &[Time]) -> Vec<Vec<Vec<Rgb>>> {
    let all = Rc::new(RefCell::new(Vec::new()));
    let seen = Rc::clone(&all);
    let visit = move |instant: Instant<'_>| {
        seen.borrow_mut().push(instant.radiosity().map(Iterator::collect).collect());
    };
    visit_instants(run, machine, machine.network(), times, visit).unwrap();
    all.take()
}

/// The light at the end is the outcome's to the bit, and the light at the start is what is emitted.
#[test]
fn the_light_comes_back_at_any_instant() {
    let (run, machine) = (run(4, rules()), paragon());
    let outcome = simulate(&run, &machine).unwrap();
    let middle = Time(outcome.time.0 / 2);
    let times = [outcome.time, Time::ZERO, middle, Time::MAX];
    let found = radiosity_at(&run, &machine, &times);
    assert_eq!(found.len(), 4);
    assert_eq!(found[2], outcome.radiosity);
    assert_eq!(found[3], outcome.radiosity);
    let total = |i: usize| -> f64 { found[i].iter().flatten().map(|b| b.element_sum()).sum() };
    assert!(total(0) < total(1) && total(1) < total(2));
    for (radiosity, geometry) in found[0].iter().zip(&run.problem.environments) {
        for (patch, radiosity) in (0..).zip(radiosity) {
            let emitted = geometry.emitted_power(&run.problem.space, patch);
            assert_eq!(*radiosity, emitted / geometry.radiosity_area(patch));
        }
    }
}

/// So it is with the ambient term, but for the order in which energies are summed.
#[test]
fn the_ambient_term_comes_back() {
    let (run, machine) = (run(4, knobs()), paragon());
    let outcome = simulate(&run, &machine).unwrap();
    let found = radiosity_at(&run, &machine, &[outcome.time]);
    let pairs = found[0].iter().flatten().zip(outcome.radiosity.iter().flatten());
    for (found, told) in pairs {
        assert!(found.abs_diff_eq(*told, 1e-9 * told.max_element()), "{found} {told}");
    }
}

/// An instant's energy is what the recording says of it.
#[test]
fn an_instant_agrees_with_the_recording() {
    let (run, machine) = (run(4, rules()), paragon());
    let (_, recording) = record(&run, &machine);
    let wanted = recording.energy[recording.energy.len() / 2];
    let seen = Rc::new(RefCell::new(Vec::new()));
    let visit = {
        let seen = Rc::clone(&seen);
        move |instant: Instant<'_>| seen.borrow_mut().push(instant.energy)
    };
    visit_instants(&run, &machine, machine.network(), &[wanted.at], visit).unwrap();
    let seen = seen.take();
    assert_eq!(seen.len(), 1);
    assert_eq!(seen[0].unshot.element_sum(), wanted.unshot);
    assert_eq!(seen[0].in_transit.element_sum(), wanted.in_transit);
}

/// Where a run passes a threshold it is, to the bit, what a run with that threshold ends with, and as long
/// but for the end itself, in one environment.
#[test]
fn a_run_tells_of_all_greater_thresholds() {
    let thresholds = [0.5, 0.02, 0.015, 0.01, 0.005];
    for rules in [rules(), knobs()] {
        let rules = Rules { patch_threshold: 0.005, ..rules };
        let (run, machine) = (Run { problem: two_rooms_cut([1; 3]), ..run(1, rules) }, paragon());
        let seen = Rc::new(RefCell::new(Vec::new()));
        let visit = {
            let seen = Rc::clone(&seen);
            move |instant: Instant<'_>| {
                let light: Vec<Vec<_>> = instant.radiosity().map(Iterator::collect).collect();
                seen.borrow_mut().push((instant.time, light));
            }
        };
        visit_stops(&run, &machine, machine.network(), &thresholds, visit).unwrap();
        let seen = seen.take();
        assert_eq!(seen.len(), thresholds.len());
        assert!(seen[0].0 < seen[2].0 && seen[2].0 < seen[4].0);
        for (patch_threshold, (time, light)) in thresholds.into_iter().zip(seen) {
            let alone =
                Run { rules: Rules { patch_threshold, ..run.rules.clone() }, ..run.clone() };
            let outcome = simulate(&alone, &machine).unwrap();
            let pairs = light.iter().flatten().zip(outcome.radiosity.iter().flatten());
            for (found, told) in pairs {
                let rounding = if run.rules.shooting.ambient { 1e-9 } else { 0.0 };
                assert!(found.abs_diff_eq(*told, rounding * told.max_element()), "{found} {told}");
            }
            let ratio = time.as_seconds_f64() / outcome.time.as_seconds_f64();
            assert!((0.98..1.001).contains(&ratio), "{patch_threshold}: {ratio}");
        }
    }
}
