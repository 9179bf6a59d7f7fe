//! The programs on a simulated machine.

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Simulation, Time};
use multicomputer::{
    CacheLevel, Caches, Machine, MachineObserver, Multicomputer, Network, Node, NodeMemory, Rank,
    Segment, Socket,
};
use radiosity::{Operation, Work};

use crate::compute_node::compute_node;
use crate::display::DisplayReport;
use crate::footprint::{Footprint, Thing};
use crate::interpreter::Interpreter;
use crate::message::Source;
use crate::observer::{Observer, SharedObserver};
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
    memory: Option<Rc<NodeMemory>>,
    /// What the processor's caches hold, if it has any.
    storage: Option<RefCell<Storage>>,
    interpreter: Option<Rc<RefCell<Interpreter>>>,
    /// To the display; the service node's.
    socket: Option<Rc<Socket<Vec<u8>>>>,
}

impl SimulatedProcess {
    fn tell_memory(&self) {
        self.observe(|to| to.memory(self.now(), self.rank(), self.node.bytes_kept()));
    }

    /// Time that it has waited for what its caches missed, and for translations of addresses.
    fn missing(&self) -> [Duration; 2] {
        let seconds = self.storage.as_ref().map_or([0.0; 2], |storage| {
            let storage = storage.borrow();
            [storage.caches().time(), storage.caches().translating_time()]
        });
        seconds.map(Duration::from_seconds_f64)
    }
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

    async fn fetch(&self, source: &Source) {
        if let Some(storage) = &self.storage {
            let before = self.missing();
            storage.borrow_mut().shoot(source);
            let after = self.missing();
            self.node.compute((after[0] - before[0]) + (after[1] - before[1])).await;
        }
    }

    fn keep(&self, segment: Segment, footprint: impl FnOnce() -> Footprint) {
        if let Some(memory) = &self.memory {
            self.node.keep(segment, footprint().bytes(memory));
            self.tell_memory();
        }
    }

    async fn touch(&self, segments: impl IntoIterator<Item = Segment>) {
        self.node.touch(segments).await;
    }

    fn release(&self, segment: Segment) {
        self.node.release(segment);
        if self.memory.is_some() {
            self.tell_memory();
        }
    }

    async fn send(&self, to: Rank, message: Vec<u8>) {
        if let Some(interpreter) = &self.interpreter {
            interpreter.borrow_mut().sends(self.rank(), &message);
        }
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

    fn queue_for_display(&self, update: &[u8]) {
        self.socket.iter().for_each(|socket| socket.queue(update.len() as u64));
    }

    fn wants_updates(&self) -> bool {
        self.socket.as_ref().is_some_and(|socket| socket.wants_more())
    }

    async fn socket_send(&self) -> bool {
        match &self.socket {
            Some(socket) => socket.send().await,
            None => false,
        }
    }

    fn now(&self) -> Time {
        self.node.now()
    }

    fn observe(&self, tell: impl FnOnce(&mut dyn Observer)) {
        if let Some(interpreter) = &self.interpreter {
            tell(&mut *interpreter.borrow_mut());
        }
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
    simulate_observed(run, machine, network, None)
}

/// The same, with all that happens told to `observer`.
pub fn simulate_observed(
    run: &Run,
    machine: &Machine,
    network: Box<dyn Network>,
    observer: Option<SharedObserver>,
) -> Result<Outcome, RunError> {
    let (nodes, collection) = run.prepare()?;
    let prices = Rc::new(Prices::of(machine)?);
    let memory = machine.node_memory.as_ref();
    if let Some(thing) = memory.and_then(Thing::without_size) {
        return Err(RunError::Size(thing));
    }
    let memory = memory.cloned().map(Rc::new);
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let multicomputer = Multicomputer::with_network(&handle, machine, run.processors, network)?;
    let caches = Some(&machine.processor.caches).filter(|caches| !caches.is_empty());
    let translations = machine.processor.translations.as_ref();
    let storage = |levels: &[CacheLevel]| {
        let caches = Caches::new(levels, translations);
        RefCell::new(Storage::new(&run.problem, Layout::PLAIN_C, caches))
    };
    let interpreter = observer.map(|observer| {
        let interpreter = Rc::new(RefCell::new(Interpreter::new(observer, run.processors + 1)));
        let observer: Rc<RefCell<dyn MachineObserver<Vec<u8>>>> = interpreter.clone();
        multicomputer.observe(&observer);
        interpreter
    });
    let process = |rank| SimulatedProcess {
        node: multicomputer.node(rank),
        prices: Rc::clone(&prices),
        memory: memory.clone(),
        storage: caches.map(|caches| storage(caches)),
        interpreter: interpreter.clone(),
        socket: None,
    };
    let finished = Rc::new(RefCell::new(Vec::new()));
    for (rank, node) in nodes.into_iter().enumerate() {
        let (process, finished) = (process(rank), Rc::clone(&finished));
        handle.spawn(format!("compute node {rank}"), async move {
            let node = compute_node(&process, node).await;
            process.node.finish();
            let (rank, now, missing) = (process.rank(), process.now(), process.missing());
            finished.borrow_mut().push((rank, now, node, missing));
        });
    }
    let mut service = process(run.processors);
    let display = machine.display.as_ref();
    let socket = display.map(|display| Rc::new(Socket::new(display, service.node.clone())));
    service.socket = socket.clone();
    handle.spawn("service node", async move {
        service_node(&service, collection).await;
        service.node.finish();
    });
    simulation.run()?;
    let mut finished = finished.take();
    finished.sort_unstable_by_key(|(rank, ..)| *rank);
    let time = finished.iter().map(|(_, time, ..)| *time).max().unwrap_or(Time::ZERO);
    let (nodes, missing): (Vec<_>, Vec<_>) =
        finished.into_iter().map(|(_, _, node, missing)| (node, missing)).unzip();
    let accounts = multicomputer.accounts();
    let reports = accounts.iter().zip(missing).map(|(account, missing)| NodeReport {
        compute: account.compute,
        missing: missing[0],
        translating: missing[1],
        overhead: account.overhead(),
        paging: account.paging,
        memory_high_water: account.memory_high_water,
        idle: account.idle,
        layer: account.layer,
        ..NodeReport::default()
    });
    let reports = reports.collect();
    let outcome = Outcome::of(time, &nodes, reports);
    let sent = outcome.counts.update_messages;
    let display = socket.map(|s| DisplayReport::of((time, sent), &accounts, &s.account()));
    Ok(Outcome { display, ..outcome })
}
