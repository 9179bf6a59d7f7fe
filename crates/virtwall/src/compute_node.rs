//! The program of a compute node: Figure 9 of RR-3008.

use std::borrow::Cow;
use std::sync::Arc;

use multicomputer::Rank;
use radiosity::{Operation, Shot, Work};

use crate::counts::Counts;
use crate::footprint::{self, Footprint};
use crate::message::{Message, Source, Sums};
use crate::process::Process;
use crate::queue::Queue;
use crate::region::Region;
use crate::ring::{Ring, Step};
use crate::rules::{Order, Ties};
use crate::shared::Shared;

/// A compute node: its part of the scene, its queue, its part in the ring.
pub struct ComputeNode {
    pub(crate) shared: Arc<Shared>,
    pub(crate) region: Region,
    queue: Queue,
    /// What is still to be shot of the patch that was selected last, the last part first.
    parts: Vec<Source>,
    /// The environment that it is at, where they are taken in turn.
    turn: u32,
    ring: Ring,
    /// Until the service node says to stop selecting local patches.
    selecting: bool,
    done: bool,
    pub(crate) tally: Tally,
}

/// What a compute node counted.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub counts: Counts,
    pub work: Work,
    /// Sources handed on, to other nodes and within this one, and those taken up again.
    pub parcels_sent: u64,
    pub parcels_taken: u64,
    /// The power in them, W.
    pub sent: radiosity::Rgb,
    pub taken: radiosity::Rgb,
}

/// Figure 9: compute while there are sources, then take part in the detection of the end, until it
/// is announced.
#[doc(alias = "Figure 9")]
#[doc(alias = "ComputeNode")]
pub async fn compute_node(process: &impl Process, mut node: ComputeNode) -> ComputeNode {
    node.settle(process);
    loop {
        while let Some(source) = node.choose_best_source(process).await {
            let shots = node.compute_illumination(process, &source).await;
            node.send_source_neighbours(process, &source, &shots).await;
            node.send_to_host(process, &source, &shots).await;
            node.read_arrived(process).await;
        }
        node.detect_termination(process).await;
        if node.done {
            return node;
        }
    }
}

impl ComputeNode {
    pub(crate) fn new(shared: &Arc<Shared>, region: Region, rank: Rank) -> ComputeNode {
        ComputeNode {
            shared: Arc::clone(shared),
            region,
            queue: Queue::default(),
            parts: Vec::new(),
            turn: 0,
            ring: Ring::new(rank, shared.processors),
            selecting: true,
            done: false,
            tally: Tally::default(),
        }
    }

    /// What the initialisation has left in memory.
    fn settle(&self, process: &impl Process) {
        let problem = &self.shared.problem;
        for (number, _) in self.region.lights() {
            let footprint = || Footprint::of_environment(problem, number);
            process.keep(footprint::environment(number), footprint);
        }
        process.keep(footprint::PROGRAM, || Footprint::of_the_program(problem));
    }

    /// §4.2.2: the greatest source, from the region or from the queue; a patch that is cut into several
    /// sources shoots them one after the other, a wall patch all that it is at once.
    async fn choose_best_source(&mut self, process: &impl Process) -> Option<Vec<Source>> {
        if let Some(part) = self.parts.pop() {
            self.tally.counts.local_shots += 1;
            return Some(vec![part]);
        }
        let only = self.environment_in_turn();
        let rules = &self.shared.rules;
        let received = self.queue.best(rules.selection, only);
        // Choice C25: the list of queued sources is searched through, and each lies in its own pages.
        let searched = self.region.changed().filter(|_| self.selecting).map(footprint::environment);
        process.touch(searched.chain(self.queue.turns().map(footprint::queued))).await;
        let (local, mut scan) = if self.selecting {
            (self.region.best_patch(only), self.region.scan())
        } else {
            (None, Work::NONE)
        };
        scan.count(Operation::QueueScan, self.queue.len() as u64);
        self.tally.work += scan;
        process.compute(|| ((), scan)).await;
        let choice = match (received, local) {
            (Some((_, place)), None) => Some(self.take_received(process, place)),
            (Some((queued, place)), Some((value, ..)))
                if queued > value || queued == value && rules.ties == Ties::ReceivedFirst =>
            {
                Some(self.take_received(process, place))
            }
            (_, Some((_, holding, patch))) => {
                self.tally.counts.local_shots += 1;
                self.parts = self.region.take(holding, patch);
                self.parts.reverse();
                self.parts.pop().map(|part| vec![part])
            }
            (None, None) => None,
        };
        self.foresee_local();
        choice
    }

    /// §5.2: stay in an environment until nothing is left there to shoot, then go on to the next that has
    /// something.
    fn environment_in_turn(&mut self) -> Option<u32> {
        if self.shared.rules.order == Order::Best {
            return None;
        }
        let has_some = |&environment: &u32| {
            let only = Some(environment);
            self.queue.best(self.shared.rules.selection, only).is_some()
                || self.selecting && self.region.best_patch(only).is_some()
        };
        let all = || self.region.lights().map(|(environment, _)| environment);
        let from_here = all().filter(|&environment| environment >= self.turn);
        self.turn = from_here.chain(all()).find(has_some).unwrap_or(self.turn);
        Some(self.turn)
    }

    /// The best local patches that are left will be shot sooner or later.
    fn foresee_local(&mut self) {
        if self.selecting && self.shared.want_jobs() {
            self.region.new_best_sources(|parcel| self.shared.foresee(Cow::Owned(parcel)));
        }
    }

    fn take_received(&mut self, process: &impl Process, place: usize) -> Vec<Source> {
        let (turn, source) = self.queue.take(place);
        process.release(footprint::queued(turn));
        self.tell_queue(process);
        self.tally.counts.received_shots += 1;
        self.tally.parcels_taken += 1;
        self.tally.taken += power_of(&source);
        source
    }

    /// §4.2.3: cast the rays of the pixels that are still true, and update radiosities.
    async fn compute_illumination(
        &mut self,
        process: &impl Process,
        source: &[Source],
    ) -> Vec<Shot> {
        for part in source {
            process.observe(|to| to.selected(process.now(), process.rank(), part));
        }
        let environment = source.first().map(|part| footprint::environment(part.environment));
        process.touch([footprint::PROGRAM].into_iter().chain(environment)).await;
        let kernel = || {
            let shots: Vec<Shot> = source.iter().map(|part| self.shared.shot(part)).collect();
            let work = shots.iter().fold(Work::NONE, |all, shot| all + shot.work);
            ((shots, work), work)
        };
        let (shots, work) = process.compute(kernel).await;
        for part in source {
            process.fetch(part).await;
        }
        (self.shared.on_shot)();
        self.tally.work += work;
        for (part, shot) in source.iter().zip(&shots) {
            let reflected = self.region.receive(part, shot);
            process.observe(|to| to.shot(process.now(), process.rank(), part, shot, reflected));
        }
        shots
    }

    /// §4.2.3: hand the source with what is left of its mask to each neighbour that it enters.
    async fn send_source_neighbours(
        &mut self,
        process: &impl Process,
        source: &[Source],
        shots: &[Shot],
    ) {
        let shared = Arc::clone(&self.shared);
        for (part, shot) in source.iter().zip(shots) {
            for onward in shared.problem.onward(part, shot) {
                self.hand_on(process, vec![onward], |mut source| {
                    source.pop().map(|onward| Message::Source(Box::new(onward)))
                })
                .await;
            }
        }
        if shared.problem.walls.is_some() {
            self.send_wall_patches(process, source, shots).await;
        }
    }

    /// Virtual walls in place of masks: gather what leaves, and hand on what wall patches have gathered
    /// where no better source is left here.
    async fn send_wall_patches(
        &mut self,
        process: &impl Process,
        source: &[Source],
        shots: &[Shot],
    ) {
        let shared = Arc::clone(&self.shared);
        let gather = |(part, shot)| self.region.gather(part, shot);
        let gathering =
            source.iter().zip(shots).map(gather).fold(Work::NONE, |all, work| all + work);
        let received = self.queue.best(shared.rules.selection, None).map(|(value, _)| value);
        let local =
            self.region.best_patch(None).filter(|_| self.selecting).map(|(value, ..)| value);
        let best = received.into_iter().chain(local).fold(shared.wall_threshold, f64::max);
        let (handed, handing) = match self.selecting {
            true => self.region.hand_on(best),
            false => (Vec::new(), Work::NONE),
        };
        self.tally.work += gathering + handing;
        process.compute(|| ((), gathering + handing)).await;
        for wall_patch in handed {
            let bins = shared.problem.bins_of(&wall_patch);
            self.hand_on(process, bins, |_| Some(Message::WallPatch(Box::new(wall_patch)))).await;
        }
    }

    /// Hand a source on to whoever owns its environment.
    async fn hand_on(
        &mut self,
        process: &impl Process,
        source: Vec<Source>,
        message: impl FnOnce(Vec<Source>) -> Option<Message>,
    ) {
        let Some(first) = source.first() else { return };
        let owner = self.shared.owners[first.environment as usize];
        source.iter().for_each(|part| self.shared.foresee(Cow::Borrowed(part)));
        self.tally.parcels_sent += 1;
        self.tally.sent += power_of(&source);
        if owner == process.rank() {
            self.enqueue(process, source);
        } else if let Some(message) = message(source) {
            let bytes = message.encode();
            self.tally.counts.messages += 1;
            self.tally.counts.message_bytes += bytes.len() as u64;
            self.ring.patch_sent();
            process.send(owner, bytes).await;
        }
    }

    /// Figure 6: tell the service node which radiosities changed, for the display.
    async fn send_to_host(&mut self, process: &impl Process, source: &[Source], shots: &[Shot]) {
        if !self.shared.rules.radiosity_updates || shots.iter().all(|shot| shot.hits.is_empty()) {
            return;
        }
        let bytes = Message::Update(self.region.updates(source, shots)).encode();
        self.tally.counts.update_messages += 1;
        self.tally.counts.update_bytes += bytes.len() as u64;
        process.send(self.shared.service_node(), bytes).await;
    }

    /// Figure 9: "Read all the sources arrived from network, put them in queue".
    async fn read_arrived(&mut self, process: &impl Process) {
        for bytes in process.received().await {
            // Processes send each other nothing but encoded messages.
            let Ok(message) = Message::decode(&bytes) else { continue };
            match message {
                Message::Source(parcel) => self.enqueue(process, vec![*parcel]),
                Message::WallPatch(wall_patch) => {
                    let bins = self.shared.problem.bins_of(&wall_patch);
                    self.enqueue(process, bins);
                }
                Message::Collect => {
                    let sums = Message::Sums(self.sums(process.rank()));
                    self.send_control(process, self.shared.service_node(), &sums).await;
                }
                Message::StopSelecting => self.selecting = false,
                Message::Token(value) => self.ring.token_arrived(value),
                Message::Done => self.done = true,
                Message::Update(_) | Message::Sums(_) => {}
            }
        }
    }

    fn enqueue(&mut self, process: &impl Process, source: Vec<Source>) {
        let footprint = Footprint::of_source(&source);
        match self.queue.push(source, self.shared.rules.merge_masks) {
            Some(turn) => process.keep(footprint::queued(turn), || footprint),
            // Taken up by another parcel, and with it when that is shot.
            None => self.tally.parcels_taken += 1,
        }
        self.tell_queue(process);
    }

    fn tell_queue(&self, process: &impl Process) {
        process.observe(|to| to.queue(process.now(), process.rank(), self.queue.len()));
    }

    /// §4.2.4: with nothing left to do, pass the token on if it is here, and wait for something to
    /// arrive.
    async fn detect_termination(&mut self, process: &impl Process) {
        match self.ring.step() {
            Step::Announce => {
                self.done = true;
                for rank in (0..=self.shared.processors).filter(|&rank| rank != process.rank()) {
                    self.send_control(process, rank, &Message::Done).await;
                }
            }
            Step::Pass(to, value) => self.send_control(process, to, &Message::Token(value)).await,
            Step::Wait => {
                process.wait().await;
                self.read_arrived(process).await;
            }
        }
    }

    async fn send_control(&mut self, process: &impl Process, to: Rank, message: &Message) {
        self.tally.counts.control_messages += 1;
        process.send(to, message.encode()).await;
    }

    fn sums(&mut self, rank: Rank) -> Sums {
        let in_parts: radiosity::Rgb = self.parts.iter().map(|part| part.emitter.power).sum();
        Sums {
            rank: rank as u32,
            unshot: (self.region.unshot_power() + in_parts).element_sum(),
            sent: self.tally.sent.element_sum(),
            taken: self.tally.taken.element_sum(),
        }
    }
}

/// The power that a source carries into an environment, W.
fn power_of(source: &[Source]) -> radiosity::Rgb {
    source.iter().map(|part| part.emitter.power * part.form_factor).sum()
}
