//! Recordings of a small run: what is told of it adds up, and comes out the same each time.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use desim::{Duration, Time};
use multicomputer::Machine;
use radiosity::{Hemisphere, HemisphereKind, PatchSize};
use virtwall::{
    KeptShots, Mapping, Observers, Order, Outcome, Problem, ProblemOptions, Rules, Run, Selection,
    SharedObserver, Shooting, Ties, simulate_observed,
};

use crate::broadcast::{Audience, Broadcast};
use crate::columns::Reader;
use crate::film::{Doing, Film};
use crate::page::Recorded;
use crate::reel::{Reel, Told};
use crate::run::{ns, told};

const PROCESSORS: usize = 5;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn machine() -> Machine {
    machine_of("paragon-xps.json")
}

fn machine_of(name: &str) -> Machine {
    let path = root().join("machines").join(name);
    Machine::from_json(&std::fs::read_to_string(path).unwrap(), name).unwrap()
}

/// A room with one lamp, cut into eight.
fn problem() -> Arc<Problem> {
    let (scene, _) = radiosity::load_obj(&root().join("scenes/room4.obj")).unwrap();
    let options = ProblemOptions {
        patch_size: PatchSize { reflector: 1.0, emitter: 0.5 },
        cells: [4, 4, 4],
        cut: [2, 2, 2],
        hemisphere: Hemisphere::new(HemisphereKind::Fibonacci, 1_024, true).unwrap(),
    };
    Arc::new(Problem::new(scene, options).unwrap())
}

fn film(problem: &Arc<Problem>, processors: usize) -> (Outcome, Film) {
    let film = Rc::new(RefCell::new(Film::new(problem, processors)));
    let outcome = observed(problem, processors, &machine(), film.clone());
    (outcome, Rc::into_inner(film).unwrap().into_inner())
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
        collect_every: Duration::from_seconds_f64(1.0),
        radiosity_updates: true,
        merge_masks: false,
        mapping: Mapping::Blocks,
        shooting: Shooting::default(),
    };
    let run = Run {
        problem: Arc::clone(problem),
        processors,
        rules,
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|| ()),
    };
    simulate_observed(&run, machine, machine.network(), Some(observer)).unwrap()
}

fn reel<'a>(problem: &'a Arc<Problem>, machine: &'a Machine, film: &'a Film) -> Reel<'a> {
    Reel {
        label: format!("room, {} processors", film.processors()),
        scene: "room".to_owned(),
        group: 0,
        problem,
        machine,
        owners: Mapping::Blocks.owners(problem.environments.len() as u32, film.processors()),
        answer: None,
        published: None,
        film,
    }
}

/// The chain leads from the start to the end without a gap, and only along messages from node to node.
#[test]
fn the_critical_path_is_whole() {
    let (problem, machine) = (problem(), machine());
    let (outcome, film) = film(&problem, PROCESSORS);
    let reel = reel(&problem, &machine, &film);
    let told = Told::of(&reel);
    let path = &told.path;
    assert!(path.len() > 10);
    assert_eq!((path[0].from, path[path.len() - 1].to), (Time::ZERO, outcome.time));
    for pair in path.windows(2) {
        assert_eq!(pair[0].to, pair[1].from);
        let moves = pair[0].node != pair[1].node;
        assert!(!moves || pair[1].doing == Doing::Travelling, "{pair:?}");
    }
    assert!((told.account.path.iter().sum::<f64>() - outcome.time.as_seconds_f64()).abs() < 1e-9);
    // Whatever waits on it, waits for a message.
    assert_eq!(told.account.path[Doing::Waiting as usize], 0.0);
}

/// All nodes' time is in the ledger, and what it says of computing is what the run says.
#[test]
fn the_ledger_holds_all_time() {
    let (problem, machine) = (problem(), machine());
    let (outcome, film) = film(&problem, PROCESSORS);
    let reel = reel(&problem, &machine, &film);
    let account = Told::of(&reel).account;
    let all = &account.all;
    let sum = all.computing() + all.overhead() + all.of_doing(Doing::Paging) + all.waiting();
    let whole = outcome.time.as_seconds_f64() * PROCESSORS as f64;
    assert!((sum - whole).abs() < 1e-9 * whole, "{sum} of {whole}");
    assert!((all.computing() / whole - outcome.busy_fraction()).abs() < 1e-9);
    assert_eq!(account.last.1, outcome.time);
    let busy = |node: usize| outcome.nodes[node].compute;
    assert!((0..PROCESSORS).all(|node| busy(node) <= busy(account.busiest)));
}

/// Runs share their shots, and the same recordings make the same bytes.
#[test]
fn recordings_are_packed_once_and_the_same() {
    let (problem, machine) = (problem(), machine());
    let films = [1, 2, PROCESSORS].map(|processors| film(&problem, processors).1);
    let pack = |films: &[Film], threads: usize| {
        let reels: Vec<Reel> = films.iter().map(|film| reel(&problem, &machine, film)).collect();
        Recorded::of(&reels, usize::MAX, threads)
    };
    let [one, all] = [&films[..1], &films].map(|films| pack(films, 2));
    let shots = |recorded: &Recorded| {
        let (_, rest) = recorded.data.split_once("id=\"shots-0\">").unwrap();
        rest.split('<').next().unwrap().to_owned()
    };
    assert_eq!(shots(&one), shots(&all), "shots depend on the processors that make them");
    assert_eq!(all.data, pack(&films, 1).data);
    let report = format!("<p>{}</p>{}", all.answers, all.data);
    let again = Recorded::in_report(&report).unwrap();
    assert_eq!((again.answers, again.data), (all.answers, all.data));
}

/// Where there is not room for all, the runs on the fewest and the most processors come first.
#[test]
fn what_has_no_room_is_left_out_and_told() {
    let (problem, machine) = (problem(), machine());
    let films = [1, 2, PROCESSORS].map(|processors| film(&problem, processors).1);
    let reels: Vec<Reel> = films.iter().map(|film| reel(&problem, &machine, film)).collect();
    let runs = |limit: usize| {
        let data = Recorded::of(&reels, limit, 1).data;
        [1, 2, PROCESSORS].map(|n| data.contains(&format!("\"label\":\"room, {n} processors\"")))
    };
    let whole = Recorded::of(&reels, usize::MAX, 1).data.len();
    let mut shown: Vec<[bool; 3]> = (0..25).rev().map(|i| runs(i * whole / 6)).collect();
    shown.dedup();
    let [all, ends] = [[true; 3], [true, false, true]];
    assert_eq!(shown, [all, ends, [true, false, false], [false; 3]]);
    assert!(Recorded::of(&reels, 0, 1).data.contains("0 of 3 recorded runs are here"));
}

/// Asks for a part after every seventh shot.
struct Listener {
    shots: u64,
    parts: Rc<RefCell<Vec<String>>>,
}

impl Audience for Listener {
    fn is_due(&mut self) -> bool {
        self.shots += 1;
        self.shots.is_multiple_of(7)
    }

    fn receive(&mut self, part: String) {
        self.parts.borrow_mut().push(part);
    }
}

#[test]
fn the_parts_of_a_run_are_the_whole() {
    parts_are_the_whole(&machine(), PROCESSORS);
    parts_are_the_whole(&machine_of("ultra1.json"), 1);
}

/// What is told of a run part by part is what was recorded of it.
fn parts_are_the_whole(machine: &Machine, processors: usize) {
    let problem = problem();
    let parts = Rc::new(RefCell::new(Vec::new()));
    let listener = Listener { shots: 0, parts: Rc::clone(&parts) };
    let film = Rc::new(RefCell::new(Film::new(&problem, processors)));
    let broadcast = Rc::new(RefCell::new(Broadcast::new(&problem, processors, listener)));
    let observers = Observers(vec![film.clone(), broadcast.clone()]);
    let outcome = observed(&problem, processors, machine, Rc::new(RefCell::new(observers)));
    broadcast.borrow_mut().tell();

    let film = film.borrow();
    let recorded = film.recording.nodes.iter().map(|node| told(node).into_iter());
    let expected: Vec<Vec<(u64, u64, u64)>> = recorded
        .map(|spans| spans.map(|s| (Doing::of(s.activity) as u64, ns(s.from), ns(s.to))).collect())
        .collect();
    let mut spans = vec![Vec::new(); processors + 1];
    let (mut ends, mut shots, mut hits) = (vec![0; processors + 1], Vec::new(), 0);
    let (mut now, mut messages) = (0, 0);
    for part in parts.borrow().iter() {
        let mut part = Reader::unpack(part);
        let at = part.ints()[0];
        assert!(at >= now);
        now = at;
        let counts = part.ints();
        let [kinds, gaps, lengths] = [0; 3].map(|_| part.ints());
        let mut nth = 0;
        for (node, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                let from = ends[node] + gaps[nth];
                ends[node] = from + lengths[nth];
                spans[node].push((kinds[nth], from, ends[node]));
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
    assert_eq!(now, ns(outcome.time));
    let counts = outcome.counts;
    assert_eq!(shots.len() as u64, counts.local_shots + counts.received_shots);
    let spans = spans.iter().flatten().filter(|(doing, ..)| *doing <= Doing::ReceivedShot as u64);
    assert_eq!(spans.count(), shots.len());
    for (rank, beams) in film.beams.iter().enumerate() {
        assert_eq!(shots.iter().filter(|&&shot| shot == rank as u64).count(), beams.len());
    }
    assert!(hits > 0);
    let arrived = film.recording.messages.iter().filter(|message| message.arrived.is_some());
    assert_eq!(messages, arrived.count());
    assert!(parts.borrow().len() > 3);
}
