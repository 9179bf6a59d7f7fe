//! The program of a compute node: Figure 9 of RR-3008.

use std::collections::BTreeSet;
use std::sync::Arc;

use radiosity::{Operation, Rgb, Shot, Work};

use super::node_result::NodeResult;
use super::process::{Event, Process, ProgramError, Step};
use super::queue::{Queue, Turn};
use super::region::{BestPatch, Region};
use super::rules::{Order, Ties};
use super::shared::Shared;
use super::termination::{Action, Termination, protocol};
use crate::problem::{Rank, Source};
use crate::walls::Walls;
use crate::wire::{Message, Sums};

/// A compute node: its part of the scene, its queue, its part in the detection of the end.
pub struct ComputeNode {
    rank: Rank,
    pub(super) shared: Arc<Shared>,
    pub(super) region: Region,
    pub(super) queue: Queue,
    /// Sources still to be shot of the patch that was selected last, the last one first.
    parts: Vec<Source>,
    /// The environment that is processed now, where they are processed one after the other.
    turn: u32,
    pub(super) walls: Walls,
    pub(super) termination: Box<dyn Termination>,
    /// True until the service node says to stop selecting local patches.
    pub(super) selecting: bool,
    done: bool,
    shots: Shots,
    transit: Transit,
}

/// Shots of local patches and of received sources.
#[derive(Default)]
struct Shots {
    local: u64,
    received: u64,
}

/// Sources that left environments, and those that were shot in the next.
#[derive(Default)]
struct Transit {
    sent: Flow,
    taken: Flow,
}

/// A number of sources.
#[derive(Default)]
struct Flow {
    sources: u64,
    /// W.
    power: Rgb,
    /// The sum of the sources' absolute power, W: that of an over-shot patch may be negative.
    magnitude: Rgb,
}

impl Flow {
    fn count(&mut self, source: &Source) {
        self.sources += 1;
        self.power += source.power();
        self.magnitude += source.power().abs();
    }
}

/// Figure 9: compute while there are sources, then take part in the detection of the end, until it is
/// announced.
///
/// # Errors
/// A message that cannot be read.
#[doc(alias = "Figure 9")]
#[doc(alias = "ComputeNode")]
pub async fn compute_node(
    process: &impl Process,
    mut node: ComputeNode,
) -> Result<NodeResult, ProgramError> {
    while !node.done {
        match node.choose_best_source(process).await {
            Some(source) => {
                let shot = node.compute_illumination(process, &source).await;
                node.send_source_neighbours(process, &source, &shot).await;
                node.send_to_host(process, &source, &shot).await;
                node.read_arrived(process).await?;
            }
            None => node.detect_termination(process).await?,
        }
    }
    Ok(node.result())
}

impl ComputeNode {
    /// §4.2.2, patch selection: the source with the most unshot energy, a local patch or one of the queue.
    async fn choose_best_source(&mut self, process: &impl Process) -> Option<Box<Source>> {
        if let Some(part) = self.parts.pop() {
            self.shots.local += 1;
            return Some(Box::new(part));
        }
        let searched = self.search(process).await;
        let only = self.environment_in_turn();
        let local = self.region.best_patch(only).filter(|_| self.selecting);
        let source = match (self.queue.best(only), local) {
            (Some((value, turn)), local) if self.goes_before(value, local) => {
                Some(self.take_received(process, turn))
            }
            (_, local) => local.and_then(|best| self.take_local(best)),
        };
        self.note_brightest(process, &searched);
        source
    }

    /// §4.2.3, radiosity computations: cast the rays of the pixels that are still true, update radiosities.
    async fn compute_illumination(&mut self, process: &impl Process, source: &Source) -> Shot {
        process.note(Event::Selected(source));
        let kernel = || {
            let shot = (self.shared.cast)(source);
            let work = shot.work;
            (shot, work)
        };
        let shot = process.compute(Step::Shoot(source), kernel).await;
        let reflected = self.region.receive(source, &shot);
        process.note(Event::Shot { source, shot: &shot, reflected });
        shot
    }

    /// §4.2.3: hand the source on to each neighbour, with the pixels whose rays enter it.
    async fn send_source_neighbours(
        &mut self,
        process: &impl Process,
        source: &Source,
        shot: &Shot,
    ) {
        let problem = Arc::clone(&self.shared.problem);
        for onward in problem.onward(source, shot).map(Box::new) {
            self.hand_on(process, &onward);
            match self.shared.owners[onward.environment as usize] {
                owner if owner == self.rank => self.enqueue(process, onward),
                owner => self.send_source(process, owner, Message::Source(onward)).await,
            }
        }
        if problem.walls.is_some() {
            self.send_wall_patches(process, source, shot).await;
        }
    }

    /// Figure 6: send the radiosities that have changed to the service node, for the display.
    async fn send_to_host(&mut self, process: &impl Process, source: &Source, shot: &Shot) {
        if self.shared.rules.radiosity_updates && !shot.hits.is_empty() {
            let update = Message::Update(self.region.updates(source, shot));
            process.send(self.shared.service_node(), update).await;
        }
    }

    /// Figure 9: "Read all the sources arrived from network, put them in queue".
    async fn read_arrived(&mut self, process: &impl Process) -> Result<(), ProgramError> {
        for (from, message) in process.receive().await? {
            match message {
                Message::Source(source) => self.enqueue(process, source),
                Message::WallPatch(wall_patch) => self.enqueue_wall_patch(process, &wall_patch),
                Message::Collect => process.send(from, Message::Sums(self.sums())).await,
                Message::StopSelecting => self.selecting = false,
                Message::Token(value) => self.termination.token_arrived(value),
                Message::Done => self.done = true,
                // Messages for the service node.
                Message::Update(_) | Message::Sums(_) => {}
            }
        }
        Ok(())
    }

    /// §4.2.4: with nothing left to do, pass the token on if it is here, else wait for a message.
    async fn detect_termination(&mut self, process: &impl Process) -> Result<(), ProgramError> {
        match self.termination.idle() {
            Action::Wait => {
                process.wait(None).await;
                self.read_arrived(process).await?;
            }
            Action::Send(to, value) => process.send(to, Message::Token(value)).await,
            Action::Announce => {
                self.done = true;
                for rank in (0..=self.shared.processors).filter(|&rank| rank != self.rank) {
                    process.send(rank, Message::Done).await;
                }
            }
        }
        Ok(())
    }
}

impl ComputeNode {
    pub(crate) fn new(shared: &Arc<Shared>, rank: Rank, threshold: f64) -> ComputeNode {
        let Shared { problem, rules, owners, processors, .. } = &**shared;
        let own = (0u32..).zip(owners).filter(|&(_, &owner)| owner == rank);
        let region = Region::new(problem, own.map(|(number, _)| number), rules, threshold);
        let turn = region.numbers().next().unwrap_or_default();
        ComputeNode {
            rank,
            shared: Arc::clone(shared),
            turn,
            region,
            queue: Queue::new(rules.selection, rules.merge_masks),
            parts: Vec::new(),
            walls: Walls::default(),
            termination: protocol(rank, *processors),
            selecting: true,
            done: false,
            shots: Shots::default(),
            transit: Transit::default(),
        }
    }

    /// The numbers of its local environments.
    pub fn environments(&self) -> impl Iterator<Item = u32> {
        self.region.numbers()
    }

    /// Search the patches of environments whose light has changed, and the queue. Returns these environments.
    async fn search(&mut self, process: &impl Process) -> BTreeSet<u32> {
        let none = BTreeSet::new();
        let (searched, mut work) = match self.selecting {
            true => (self.region.changed(), self.region.search()),
            false => (&none, Work::NONE),
        };
        work.count(Operation::QueueScan, self.queue.waiting() as u64);
        let step = Step::Select { searched, queued: &self.queue };
        process.compute(step, || ((), work)).await;
        if self.selecting { self.region.searched() } else { none }
    }

    /// The environment to choose from, if environments are processed one after the other (§5.2): the same one
    /// until nothing is left there to shoot, then the next that has a source.
    fn environment_in_turn(&mut self) -> Option<u32> {
        if self.shared.rules.order == Order::Best {
            return None;
        }
        let has_some = |&environment: &u32| {
            let only = Some(environment);
            self.queue.best(only).is_some()
                || self.selecting && self.region.best_patch(only).is_some()
        };
        let from_here = self.region.numbers().filter(|&environment| environment >= self.turn);
        let next = from_here.chain(self.region.numbers()).find(has_some);
        self.turn = next.unwrap_or(self.turn);
        Some(self.turn)
    }

    /// Whether a received source of this value is shot before the best local patch.
    fn goes_before(&self, value: f64, local: Option<BestPatch>) -> bool {
        let ties = self.shared.rules.ties;
        local.is_none_or(|local| {
            value > local.value || value == local.value && ties == Ties::ReceivedFirst
        })
    }

    fn take_received(&mut self, process: &impl Process, turn: Turn) -> Box<Source> {
        let source = self.queue.take(turn);
        process.note(Event::Taken { turn, waiting: self.queue.waiting() });
        self.shots.received += 1;
        self.transit.taken.count(&source);
        source
    }

    fn take_local(&mut self, best: BestPatch) -> Option<Box<Source>> {
        self.shots.local += 1;
        self.parts = self.region.take(best);
        self.parts.reverse();
        self.parts.pop().map(Box::new)
    }

    fn note_brightest(&mut self, process: &impl Process, searched: &BTreeSet<u32>) {
        if self.selecting {
            let bests = self.region.new_bests(searched);
            bests.iter().for_each(|emitter| process.note(Event::Brightest(emitter)));
        }
    }

    /// Count and report a source that leaves for its environment.
    pub(super) fn hand_on(&mut self, process: &impl Process, source: &Source) {
        process.note(Event::HandedOn(source));
        self.transit.sent.count(source);
    }

    /// Send sources to another node.
    pub(super) async fn send_source(&mut self, process: &impl Process, to: Rank, message: Message) {
        self.termination.source_sent();
        process.send(to, message).await;
    }

    pub(super) fn enqueue(&mut self, process: &impl Process, source: Box<Source>) {
        match self.queue.push(source) {
            Some(turn) => {
                let (source, waiting) = (self.queue.get(turn), self.queue.waiting());
                process.note(Event::Queued { source, turn, waiting });
            }
            // Merged with another, and shot with that.
            None => self.transit.taken.sources += 1,
        }
    }

    /// What the service node collects (§4.2.4). Over-shooting leaves negative power, which is to be shot as
    /// well: so all sums are of magnitudes.
    fn sums(&mut self) -> Sums {
        let parts: Rgb = self.parts.iter().map(|part| part.power().abs()).sum();
        let unshot = self.region.unshot_magnitude() + self.walls.power().abs() + parts;
        Sums {
            rank: self.rank as u32,
            unshot: unshot.element_sum(),
            sent: self.transit.sent.magnitude.element_sum(),
            taken: self.transit.taken.magnitude.element_sum(),
        }
    }

    fn result(self) -> NodeResult {
        let Transit { sent, taken } = self.transit;
        let parts: Rgb = self.parts.iter().map(Source::power).sum();
        NodeResult {
            rank: self.rank,
            local_shots: self.shots.local,
            received_shots: self.shots.received,
            pending: sent.sources as i64 - taken.sources as i64 + self.parts.len() as i64,
            in_transit: sent.power - taken.power + parts,
            on_walls: self.walls.power(),
            environments: self.region.results(),
        }
    }
}
