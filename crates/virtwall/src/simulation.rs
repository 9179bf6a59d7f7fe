//! The programs on a simulated machine.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use desim::{Duration, Simulation, Time};
use multicomputer::{Machine, Multicomputer, Network, Node, Rank};
use radiosity::{Operation, Work};

use crate::compute_node::compute_node;
use crate::message::Parcel;
use crate::outcome::{NodeReport, Outcome};
use crate::process::Process;
use crate::run::{Run, RunError};
use crate::service_node::service_node;
use crate::storage::{Layout, Storage};

/// What each operation costs a processor, seconds.
struct Prices([f64; Operation::ALL.len()]);

impl Prices {
    fn of(machine: &Machine) -> Result<Prices, RunError> {
        let mut prices = [0.0; Operation::ALL.len()];
        for (price, &operation) in prices.iter_mut().zip(Operation::ALL) {
            let seconds = machine.processor.price(operation.name());
            *price = seconds.ok_or(RunError::Price(operation))?;
        }
        Ok(Prices(prices))
    }

    fn time(&self, work: &Work) -> Duration {
        let costs = work.counts().zip(&self.0).map(|((_, times), price)| times as f64 * price);
        Duration::from_seconds_f64(costs.sum())
    }
}

/// A process on a simulated node.
struct SimulatedProcess {
    node: Node<Vec<u8>>,
    prices: Rc<Prices>,
    /// Where the processor has caches.
    storage: Option<RefCell<Storage>>,
    missing: Cell<Duration>,
}

impl Process for SimulatedProcess {
    fn rank(&self) -> Rank {
        self.node.rank()
    }

    async fn compute<T>(&self, job: impl FnOnce() -> (T, Work)) -> T {
        let (result, work) = job();
        self.node.compute(self.prices.time(&work)).await;
        result
    }

    async fn fetch(&self, source: &Parcel) {
        let Some(storage) = &self.storage else { return };
        let span = Duration::from_seconds_f64(storage.borrow_mut().shoot(source));
        self.missing.set(self.missing.get() + span);
        self.node.compute(span).await;
    }

    async fn send(&self, to: Rank, message: Vec<u8>) {
        self.node.send(to, message.len() as u64, message).await;
    }

    async fn received(&self) -> Vec<Vec<u8>> {
        self.node.received().await
    }

    async fn wait(&self) {
        self.node.wait().await;
    }

    async fn wait_until(&self, time: Time) -> bool {
        self.node.wait_until(time).await
    }

    fn now(&self) -> Time {
        self.node.now()
    }
}

/// Run on a simulated machine.
pub fn simulate(run: &Run, machine: &Machine) -> Result<Outcome, RunError> {
    simulate_over(run, machine, machine.network())
}

/// Run on a simulated machine with another network than its own.
pub fn simulate_over(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
) -> Result<Outcome, RunError> {
    let (nodes, collection) = run.prepare()?;
    let prices = Rc::new(Prices::of(machine)?);
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let multicomputer = Multicomputer::with_network(&handle, machine, run.processors, network)?;
    let caches = &machine.processor.caches;
    let storage = || Storage::new(&run.problem, Layout::PLAIN_C, caches);
    let process = |rank| SimulatedProcess {
        node: multicomputer.node(rank),
        prices: Rc::clone(&prices),
        storage: (!caches.is_empty()).then(|| RefCell::new(storage())),
        missing: Cell::default(),
    };
    let finished = Rc::new(RefCell::new(Vec::new()));
    for (rank, node) in nodes.into_iter().enumerate() {
        let (process, finished) = (process(rank), Rc::clone(&finished));
        handle.spawn(format!("compute node {rank}"), async move {
            let node = compute_node(&process, node).await;
            process.node.finish();
            let missing = process.missing.get();
            finished.borrow_mut().push((process.rank(), process.now(), node, missing));
        });
    }
    let service = process(run.processors);
    handle.spawn("service node", async move { service_node(&service, collection).await });
    simulation.run()?;
    let mut finished = finished.take();
    finished.sort_unstable_by_key(|(rank, ..)| *rank);
    let time = finished.iter().map(|(_, time, ..)| *time).max().unwrap_or(Time::ZERO);
    let (nodes, missing): (Vec<_>, Vec<_>) =
        finished.into_iter().map(|(_, _, node, missing)| (node, missing)).unzip();
    let reports =
        multicomputer.accounts().into_iter().zip(missing).map(|(account, missing)| NodeReport {
            compute: account.compute,
            missing,
            overhead: account.send_overhead + account.receive_overhead,
            idle: account.idle,
            ..NodeReport::default()
        });
    let reports = reports.collect();
    Ok(Outcome::of(time, &nodes, reports))
}
