//! Recordings of a small run: their analysis adds up, and their blocks are deterministic and complete.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use desim::{Duration, Time};
use multicomputer::{CacheLevel, Machine};
use radiosity::{Hemisphere, HemisphereKind, PatchSize};
use virtwall::{
    KeptShots, Mapping, Observers, Order, Outcome, Problem, ProblemOptions, Rules, Run, Selection,
    SharedObserver, Shooting, Ties, simulate_observed,
};

use crate::broadcast::{Broadcast, Subscriber};
use crate::explain::AnalysedRun;
use crate::pack::{Reader, nanoseconds, shown_spans};
use crate::page::ReportParts;
use crate::record::{LightRecording, NodeState, RecordedRun, is_shot};

const PROCESSORS: usize = 5;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn machine() -> Machine {
    machine_of("paragon-xps.json")
}

fn machine_of(name: &str) -> Machine {
    let path = Path::new(ROOT).join("machines").join(name);
    Machine::from_json(&std::fs::read_to_string(path).unwrap(), name).unwrap()
}

/// A room with one lamp, cut into eight.
fn problem() -> Arc<Problem> {
    let (scene, _) = radiosity::load_obj(&Path::new(ROOT).join("scenes/room4.obj")).unwrap();
    let options = ProblemOptions {
        patch_size: PatchSize { reflector: 1.0, emitter: 0.5 },
        cells: [4, 4, 4],
        cut: [2, 2, 2],
        hemisphere: Hemisphere::new(HemisphereKind::Fibonacci, 1_024, true).unwrap(),
    };
    Arc::new(Problem::new(scene, options).unwrap())
}

fn record(problem: &Arc<Problem>, processors: usize) -> (Outcome, LightRecording) {
    let recording = Rc::new(RefCell::new(LightRecording::new(problem, processors)));
    let outcome = observed(problem, processors, &machine(), recording.clone());
    (outcome, Rc::into_inner(recording).unwrap().into_inner())
}

fn observed(
    problem: &Arc<Problem>,
    processors: usize,
    machine: &Machine,
    observer: SharedObserver,
) -> Outcome {
    let rules = Rules {
        selection: Selection::Energy,
        ties: Ties::ReceivedFirst,
        order: Order::Best,
        patch_threshold: 0.02,
        wall_threshold: 1e-4,
        energy_threshold: 0.0,
        shots_without_progress: None,
        collect_every: Duration::from_seconds_f64(1.0),
        radiosity_updates: true,
        merge_masks: false,
        mapping: Mapping::Blocks,
        seed: 0,
        shooting: Shooting::default(),
    };
    let run = Run {
        problem: Arc::clone(problem),
        processors,
        rules,
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    };
    simulate_observed(&run, machine, machine.network(), Some(observer)).unwrap()
}

fn recorded_run<'a>(
    problem: &'a Arc<Problem>,
    machine: &'a Machine,
    recording: &'a LightRecording,
) -> RecordedRun<'a> {
    RecordedRun {
        label: format!("room, {} processors", recording.processors()),
        scene: "room".to_owned(),
        group: 0,
        problem,
        machine,
        owners: Mapping::Blocks.owners(
            problem.environments.len() as u32,
            recording.processors(),
            0,
        ),
        answer: None,
        published: None,
        recording,
    }
}

/// It leads from the start to the end without a gap, and from node to node only along messages.
#[test]
fn the_critical_path_is_complete() {
    let (problem, machine) = (problem(), machine());
    let (outcome, recording) = record(&problem, PROCESSORS);
    let run = recorded_run(&problem, &machine, &recording);
    let analysed = AnalysedRun::of(&run);
    let path = &analysed.path;
    assert!(path.len() > 10);
    assert_eq!((path[0].from, path[path.len() - 1].to), (Time::ZERO, outcome.time));
    for pair in path.windows(2) {
        assert_eq!(pair[0].to, pair[1].from);
        let moves = pair[0].node != pair[1].node;
        assert!(!moves || pair[1].state == NodeState::Travelling, "{pair:?}");
    }
    assert!(
        (analysed.path_seconds.iter().sum::<f64>() - outcome.time.as_seconds_f64()).abs() < 1e-9
    );
    // Every wait on it is explained by a message.
    assert_eq!(analysed.path_seconds[NodeState::Waiting as usize], 0.0);
}

/// The parts of all nodes' time add up, and the time in kernels is the run's.
#[test]
fn the_time_breakdown_is_complete() {
    let (problem, machine) = (problem(), machine());
    let (outcome, recording) = record(&problem, PROCESSORS);
    let run = recorded_run(&problem, &machine, &recording);
    let analysed = AnalysedRun::of(&run);
    let all = &analysed.all;
    let sum = all.computing() + all.overhead() + all.in_state(NodeState::Paging) + all.waiting();
    let whole = outcome.time.as_seconds_f64() * PROCESSORS as f64;
    assert!((sum - whole).abs() < 1e-9 * whole, "{sum} of {whole}");
    assert!((all.computing() / whole - outcome.busy_fraction()).abs() < 1e-9);
    assert_eq!(analysed.last.1, outcome.time);
    let busy = |node: usize| outcome.nodes[node].compute;
    assert!((0..PROCESSORS).all(|node| busy(node) <= busy(analysed.busiest)));
}

/// Runs share their shots, and the same recordings give the same bytes.
/// Cache misses are a second span of each shot.
#[test]
fn seconds_of_environments_are_those_of_their_shots() {
    let problem = problem();
    let seconds = |processors, caches: &[CacheLevel]| {
        let mut machine = machine();
        machine.processor.caches = caches.to_vec();
        let recording = Rc::new(RefCell::new(LightRecording::new(&problem, processors)));
        observed(&problem, processors, &machine, recording.clone());
        let recording = Rc::into_inner(recording).unwrap().into_inner();
        let run = recorded_run(&problem, &machine, &recording);
        let environments = AnalysedRun::of(&run).environments;
        let nodes = recording.recording.nodes[..processors].iter();
        let shots: Duration = nodes.map(|node| node.time(is_shot)).sum();
        let sum: f64 = environments.iter().sum();
        assert!((sum / shots.as_seconds_f64() - 1.0).abs() < 1e-9, "{sum} of {shots}");
        environments
    };
    let cache = CacheLevel { size: 8_192, line: 32, ways: 1, miss_time: 1e-6 };
    for processors in [1, PROCESSORS] {
        seconds(processors, &[]);
        seconds(processors, std::slice::from_ref(&cache));
    }
    // On one processor the shots are the same, and each takes longer.
    let (without, with) = (seconds(1, &[]), seconds(1, &[cache]));
    assert_eq!(without.len(), with.len());
    assert!(without.iter().zip(&with).all(|(a, b)| a < b), "{without:?} {with:?}");
}

#[test]
fn blocks_are_deterministic() {
    let (problem, machine) = (problem(), machine());
    let recordings = [1, 2, PROCESSORS].map(|processors| record(&problem, processors).1);
    let pack = |recordings: &[LightRecording], threads: usize| {
        let runs = recordings.iter().map(|recording| recorded_run(&problem, &machine, recording));
        ReportParts::of(&runs.collect::<Vec<_>>(), usize::MAX, threads)
    };
    let [one, all] = [&recordings[..1], &recordings].map(|recordings| pack(recordings, 2));
    let shots = |parts: &ReportParts| {
        let (_, rest) = parts.data.split_once("id=\"shots-0\">").unwrap();
        rest.split('<').next().unwrap().to_owned()
    };
    assert_eq!(shots(&one), shots(&all), "shots depend on the number of processors");
    assert_eq!(all.data, pack(&recordings, 1).data);
    let report = format!("<p>{}</p>{}", all.answers, all.data);
    let again = ReportParts::in_report(&report).unwrap();
    assert_eq!((again.answers, again.data), (all.answers, all.data));
}

/// Without room for all, the runs on the fewest and the most processors come first.
#[test]
fn runs_without_room_are_left_out_and_named() {
    let (problem, machine) = (problem(), machine());
    let recordings = [1, 2, PROCESSORS].map(|processors| record(&problem, processors).1);
    let runs = recordings.iter().map(|recording| recorded_run(&problem, &machine, recording));
    let runs: Vec<RecordedRun> = runs.collect();
    let shown = |limit: usize| {
        let data = ReportParts::of(&runs, limit, 1).data;
        [1, 2, PROCESSORS].map(|n| data.contains(&format!("\"label\":\"room, {n} processors\"")))
    };
    let whole = ReportParts::of(&runs, usize::MAX, 1).data.len();
    let mut seen: Vec<[bool; 3]> = (0..25).rev().map(|i| shown(i * whole / 6)).collect();
    seen.dedup();
    let [all, ends] = [[true; 3], [true, false, true]];
    assert_eq!(seen, [all, ends, [true, false, false], [false; 3]]);
    assert!(ReportParts::of(&runs, 0, 1).data.contains("0 of 3 recorded runs are here"));
}

/// Asks for a part after every seventh shot.
struct Listener {
    shots: u64,
    parts: Rc<RefCell<Vec<String>>>,
}

impl Subscriber for Listener {
    fn is_due(&mut self) -> bool {
        self.shots += 1;
        self.shots.is_multiple_of(7)
    }

    fn receive(&mut self, part: String) {
        self.parts.borrow_mut().push(part);
    }
}

#[test]
fn the_parts_of_a_run_are_complete() {
    parts_are_complete(&machine(), PROCESSORS);
    parts_are_complete(&machine_of("ultra1.json"), 1);
}

/// The parts of a run together contain what was recorded of it.
fn parts_are_complete(machine: &Machine, processors: usize) {
    let problem = problem();
    let parts = Rc::new(RefCell::new(Vec::new()));
    let listener = Listener { shots: 0, parts: Rc::clone(&parts) };
    let recording = Rc::new(RefCell::new(LightRecording::new(&problem, processors)));
    let broadcast = Rc::new(RefCell::new(Broadcast::new(&problem, processors, listener)));
    let observers = Observers(vec![recording.clone(), broadcast.clone()]);
    let outcome = observed(&problem, processors, machine, Rc::new(RefCell::new(observers)));
    broadcast.borrow_mut().flush();

    let recording = recording.borrow();
    let row = |span: virtwall::Span| {
        let state = NodeState::of(span.activity) as u64;
        (state, nanoseconds(span.from), nanoseconds(span.to))
    };
    let recorded = recording.recording.nodes.iter();
    let expected: Vec<Vec<(u64, u64, u64)>> =
        recorded.map(|node| shown_spans(node).into_iter().map(row).collect()).collect();
    let mut spans = vec![Vec::new(); processors + 1];
    let (mut ends, mut shots, mut hits) = (vec![0; processors + 1], Vec::new(), 0);
    let (mut now, mut messages) = (0, 0);
    for part in parts.borrow().iter() {
        let mut part = Reader::unpack(part);
        let at = part.ints()[0];
        assert!(at >= now);
        now = at;
        let counts = part.ints();
        let [states, gaps, lengths] = [0; 3].map(|_| part.ints());
        let mut nth = 0;
        for (node, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                let from = ends[node] + gaps[nth];
                ends[node] = from + lengths[nth];
                spans[node].push((states[nth], from, ends[node]));
                nth += 1;
            }
        }
        let [_, _, ranks] = [0; 3].map(|_| part.ints());
        shots.extend(ranks);
        let [_, _, _, _, _, _] = [0; 6].map(|_| part.ints());
        part.floats();
        part.floats();
        part.ints();
        hits += part.ints().into_iter().sum::<u64>();
        let [_, _, _, _, _, _] = [0; 6].map(|_| part.ints());
        messages += part.ints().len();
    }
    assert_eq!(spans, expected);
    assert_eq!(now, nanoseconds(outcome.time));
    let counts = outcome.counts;
    assert_eq!(shots.len() as u64, counts.local_shots + counts.received_shots);
    let spans =
        spans.iter().flatten().filter(|(state, ..)| *state <= NodeState::ReceivedShot as u64);
    assert_eq!(spans.count(), shots.len());
    for (rank, recorded) in recording.shots.iter().enumerate() {
        assert_eq!(shots.iter().filter(|&&shot| shot == rank as u64).count(), recorded.len());
    }
    assert!(hits > 0);
    let arrived = recording.recording.messages.iter().filter(|message| message.arrived.is_some());
    assert_eq!(messages, arrived.count());
    assert!(parts.borrow().len() > 3);
}
