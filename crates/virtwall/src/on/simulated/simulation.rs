//! Runs the programs on a simulated machine: one process for each node.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use desim::{Duration, Simulation, Time};
use multicomputer::{
    Caches, Machine, MachineObserver, Multicomputer, Network, NodeAccount, Socket,
};

use super::footprint::Thing;
use super::interpreter::{Envelope, Interpreter};
use super::layout::Layout;
use super::prices::Prices;
use super::process::SimulatedProcess;
use super::storage::Storage;
use crate::observe::SharedObserver;
use crate::on::error::RunError;
use crate::on::host::{Meter, balanced, total};
use crate::on::prepared::Prepared;
use crate::problem::Rank;
use crate::program::{NodeResult, Process, ProgramError, compute_node, service_node};
use crate::run::{DisplayReport, NodeReport, Outcome, Run};

/// Carries out a run on a simulated machine.
///
/// # Errors
/// Why the run could not be made, or did not end.
pub fn simulate(run: &Run, machine: &Machine) -> Result<Outcome, RunError> {
    simulate_observed(run, machine, machine.network(), None)
}

/// Carries out a run on a simulated machine, with `network` in place of the machine's own, and an observer.
pub fn simulate_observed(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
    observer: Option<SharedObserver>,
) -> Result<Outcome, RunError> {
    let Prepared { nodes, collection, host } = Prepared::new(run)?;
    let prices = Rc::new(Prices::of(machine)?);
    let memory = machine.node_memory.as_ref();
    if let Some(memory) = memory {
        let things = Thing::ALL.map(|(_, name)| name);
        RunError::require_all("memory has no size", things, &memory.sizes, "bytes")?;
    }
    let memory = memory.cloned().map(Rc::new);
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let multicomputer = Multicomputer::with_network(&handle, machine, run.processors, network)?;
    let interpreter = observer.map(|observer| interpreter(observer, run, &multicomputer));
    let meters: Vec<Rc<Meter>> = (0..=run.processors).map(|_| Rc::default()).collect();
    let process = |rank: Rank| SimulatedProcess {
        node: multicomputer.node(rank),
        problem: Arc::clone(&run.problem),
        prices: Rc::clone(&prices),
        memory: memory.clone(),
        storage: storage(run, machine),
        interpreter: interpreter.clone(),
        host: host.clone(),
        meter: Rc::clone(&meters[rank]),
    };
    let finished = Rc::new(RefCell::new(Vec::new()));
    let failed = Rc::new(RefCell::new(None));
    for (rank, node) in nodes.into_iter().enumerate() {
        let (process, finished, failed) = (process(rank), Rc::clone(&finished), Rc::clone(&failed));
        let environments: Vec<u32> = node.environments().collect();
        handle.spawn(format!("compute node {rank}"), async move {
            process.settle(environments.into_iter());
            match compute_node(&process, node).await {
                Ok(result) => finished.borrow_mut().push(Finished::new(&process, result)),
                Err(error) => *failed.borrow_mut() = Some(error),
            }
            process.node.finish();
        });
    }
    let service = process(run.processors);
    let socket = machine.display.as_ref();
    let socket = socket.map(|display| Rc::new(Socket::new(display, service.node.clone())));
    let (display, service_failed) = (socket.clone(), Rc::clone(&failed));
    handle.spawn("service node", async move {
        if let Err(error) = service_node(&service, &display, collection).await {
            *service_failed.borrow_mut() = Some(error);
        }
        service.node.finish();
    });
    let ended = simulation.run();
    // If a program could not go on, the others wait for it and the run stalls. So its error is reported first.
    let failed: Option<ProgramError> = failed.take();
    failed.map_or(Ok(()), Err)?;
    ended?;
    let accounts = multicomputer.accounts();
    let counted = total(meters.iter().map(|meter| meter.read()));
    let (time, results, reports) = reports(&accounts, finished.take());
    let outcome = balanced(Outcome::of(run, time, results, counted, reports))?;
    let ended = (outcome.time, outcome.counts.update_messages);
    let display = socket.map(|s| DisplayReport::of(ended, &accounts, &s.account()));
    Ok(Outcome { display, ..outcome })
}

/// What stands between the machine and an observer of the run.
fn interpreter(
    observer: SharedObserver,
    run: &Run,
    multicomputer: &Multicomputer<Envelope>,
) -> Rc<RefCell<Interpreter>> {
    let interpreter = Rc::new(RefCell::new(Interpreter::new(observer, run.processors + 1)));
    let observer: Rc<RefCell<dyn MachineObserver<Envelope>>> = interpreter.clone();
    multicomputer.observe(&observer);
    interpreter
}

/// Addresses of the records that kernels touch, and the machine's caches, if it has any. Each node starts
/// with empty caches.
fn storage(run: &Run, machine: &Machine) -> Option<RefCell<Storage>> {
    let levels = Some(&machine.processor.caches).filter(|caches| !caches.is_empty())?;
    let caches = Caches::new(levels, machine.processor.translations.as_ref());
    Some(RefCell::new(Storage::new(&run.problem, Layout::PLAIN_C, caches)))
}

/// A compute node that has ended.
struct Finished {
    at: Time,
    result: NodeResult,
    /// Time of cache misses, and of address translations.
    missing: [Duration; 2],
}

impl Finished {
    fn new(process: &SimulatedProcess, result: NodeResult) -> Finished {
        Finished { at: process.now(), result, missing: process.missing() }
    }
}

/// The time of the last node's end, and what each has found and done, by rank.
fn reports(
    accounts: &[NodeAccount],
    mut finished: Vec<Finished>,
) -> (Time, Vec<NodeResult>, Vec<NodeReport>) {
    finished.sort_unstable_by_key(|node| node.result.rank);
    let time = finished.iter().map(|node| node.at).max().unwrap_or(Time::ZERO);
    let reports = accounts.iter().zip(&finished).map(|(account, node)| NodeReport {
        compute: account.compute,
        missing: node.missing[0],
        translating: node.missing[1],
        overhead: account.overhead(),
        paging: account.paging,
        memory_high_water: account.memory_high_water,
        idle: account.idle,
        layer: account.layer,
        ..NodeReport::default()
    });
    let reports = reports.collect();
    (time, finished.into_iter().map(|node| node.result).collect(), reports)
}
