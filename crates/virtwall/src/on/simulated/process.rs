//! A process on a simulated node: from the program's steps and events it derives what they cost.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use desim::{Duration, Time};
use multicomputer::{Node, NodeMemory, Socket};
use radiosity::Work;

use super::footprint::{self, Footprint};
use super::interpreter::{Envelope, Interpreter};
use super::prices::Prices;
use super::storage::Storage;
use crate::on::host::{Host, Meter, decode};
use crate::problem::{Problem, Rank};
use crate::program::{Display, Event, Process, ProgramError, Step};
use crate::wire::{Message, MessageKind};

/// A process on a simulated node.
pub(super) struct SimulatedProcess {
    pub node: Node<Envelope>,
    pub problem: Arc<Problem>,
    pub prices: Rc<Prices>,
    /// Memory of the node, where it is modelled.
    pub memory: Option<Rc<NodeMemory>>,
    /// What the processor's caches hold, where they are modelled.
    pub storage: Option<RefCell<Storage>>,
    pub interpreter: Option<Rc<RefCell<Interpreter>>>,
    pub host: Host,
    pub meter: Rc<Meter>,
}

impl SimulatedProcess {
    /// Keep what the initialisation leaves in memory: these environments, and the program.
    pub fn settle(&self, environments: impl Iterator<Item = u32>) {
        for number in environments {
            let footprint = || Footprint::of_environment(&self.problem, number);
            self.keep(footprint::environment(number), footprint);
        }
        self.keep(footprint::PROGRAM, || Footprint::of_the_program(&self.problem));
    }

    fn keep(&self, segment: multicomputer::Segment, footprint: impl FnOnce() -> Footprint) {
        if let Some(memory) = &self.memory {
            self.node.keep(segment, footprint().bytes(memory));
            self.observe_memory();
        }
    }

    fn release(&self, segment: multicomputer::Segment) {
        if self.memory.is_some() {
            self.node.release(segment);
            self.observe_memory();
        }
    }

    fn observe_memory(&self) {
        self.observe(|to| to.memory(self.now(), self.rank(), self.node.bytes_kept()));
    }

    fn observe(&self, call: impl FnOnce(&mut Interpreter)) {
        if let Some(interpreter) = &self.interpreter {
            call(&mut interpreter.borrow_mut());
        }
    }

    /// Page in what a step uses.
    ///
    /// Choice C25: a shot uses the whole environment and the program with its table of directions; a
    /// selection uses the environments that it searches and every queued source, whose energy lies in its
    /// own 4 KB.
    async fn page_in(&self, step: &Step<'_>) {
        match step {
            Step::Select { searched, queued } => {
                let searched = searched.iter().copied().map(footprint::environment);
                self.node.touch(searched.chain(queued.turns().map(footprint::queued))).await;
            }
            Step::Shoot(source) => {
                let environment = footprint::environment(source.environment);
                self.node.touch([footprint::PROGRAM, environment]).await;
            }
            Step::Gather => {}
        }
    }

    /// Wait for what a step and the search after it miss in the caches.
    async fn fetch(&self, step: &Step<'_>) {
        if let (Some(storage), Step::Shoot(source)) = (&self.storage, step) {
            let before = self.missing();
            storage.borrow_mut().shoot(source);
            let after = self.missing();
            self.node.compute((after[0] - before[0]) + (after[1] - before[1])).await;
        }
    }

    /// Time spent so far on cache misses, and on misses of the translation look-aside buffer.
    pub fn missing(&self) -> [Duration; 2] {
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

    fn now(&self) -> Time {
        self.node.now()
    }

    async fn compute<T>(&self, step: Step<'_>, job: impl FnOnce() -> (T, Work)) -> T {
        self.page_in(&step).await;
        let (result, work) = job();
        self.meter.work(work);
        self.node.compute(self.prices.time(&work)).await;
        self.fetch(&step).await;
        result
    }

    async fn send(&self, to: Rank, message: Message) {
        let kind = MessageKind::of(&message);
        let bytes = self.meter.encode(&message);
        self.observe(|to| to.sends(self.rank(), kind));
        let length = bytes.len() as u64;
        self.node.send(to, length, Envelope { from: self.rank(), kind, bytes }).await;
    }

    async fn receive(&self) -> Result<Vec<(Rank, Message)>, ProgramError> {
        self.host.progress.check()?;
        let arrived = self.node.received().await.into_iter();
        arrived.map(|envelope| decode(self.rank(), envelope.from, &envelope.bytes)).collect()
    }

    async fn wait(&self, until: Option<Time>) -> bool {
        match until {
            Some(time) => self.node.wait_until(time).await,
            None => {
                self.node.wait().await;
                true
            }
        }
    }

    fn note(&self, event: Event<'_>) {
        self.host.note(&event);
        match event {
            Event::Queued { source, turn, .. } => {
                self.keep(footprint::queued(turn), || Footprint::of_source(source));
            }
            Event::Taken { turn, .. } => self.release(footprint::queued(turn)),
            _ => {}
        }
        self.observe(|to| to.note(self.now(), self.rank(), &event));
    }
}

/// The way from the service node to the display, where the machine has one.
impl Display for Option<Rc<Socket<Envelope>>> {
    fn queue(&self, update: &Message) {
        self.iter().for_each(|socket| socket.queue(update.encode().len() as u64));
    }

    fn wants_more(&self) -> bool {
        self.as_ref().is_some_and(|socket| socket.wants_more())
    }

    async fn socket_send(&self) -> bool {
        match self {
            Some(socket) => socket.send().await,
            None => false,
        }
    }
}
