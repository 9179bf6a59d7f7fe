//! The program of the service node: Figure 6 of RR-3008, with the way to the display, and the
//! collection of §4.2.4.

use desim::{Duration, Time};

use crate::message::{Message, Sums};
use crate::process::Process;

/// When the service node collects, and when it tells compute nodes to stop selecting patches.
#[derive(Clone, Copy, Debug)]
pub struct Collection {
    /// Number of compute nodes; their ranks start at 0.
    pub compute_nodes: usize,
    /// Time from the end of one collection to the next.
    pub every: Duration,
    /// Stop when less than this much power is unshot or under way, W.
    pub stop_below: f64,
}

/// Gather radiosity updates until a compute node announces the end; meanwhile collect energies.
#[doc(alias = "ServiceNode")]
#[doc(alias = "Figure 6")]
pub async fn service_node(process: &impl Process, collection: Collection) {
    let sums = vec![None; collection.compute_nodes];
    let mut answers = Answers { missing: sums.len(), sums, done: false };
    let mut stopped = false;
    loop {
        let next = process.now() + collection.every;
        answers.receive_until(process, next).await;
        answers.collect(process).await;
        if answers.done {
            return;
        }
        // The answers are of slightly different moments, as they would be on the real machine.
        if !stopped && answers.power_left() < collection.stop_below {
            stopped = true;
            answers.tell_all(process, &Message::StopSelecting).await;
        }
    }
}

/// What compute nodes have told the service node.
struct Answers {
    /// By rank.
    sums: Vec<Option<Sums>>,
    /// How many have not answered yet.
    missing: usize,
    done: bool,
}

impl Answers {
    /// Receive until a time or the end.
    async fn receive_until(&mut self, process: &impl Process, time: Time) {
        while !self.done && process.wait_until(time).await {
            self.receive(process).await;
        }
    }

    /// Ask every compute node and receive until all have answered, or the end.
    async fn collect(&mut self, process: &impl Process) {
        if self.done {
            return;
        }
        self.sums.fill(None);
        self.missing = self.sums.len();
        self.tell_all(process, &Message::Collect).await;
        while !self.done && self.missing > 0 {
            process.wait().await;
            self.receive(process).await;
        }
    }

    /// Read what has arrived, and send radiosity updates on to the display.
    ///
    /// A service node that drowns in them collects late.
    async fn receive(&mut self, process: &impl Process) {
        self.read(process).await;
        while process.socket_send().await {
            if process.wants_updates() {
                self.read(process).await;
            }
        }
    }

    async fn read(&mut self, process: &impl Process) {
        for bytes in process.received().await {
            match Message::decode(&bytes) {
                Ok(Message::Sums(sums)) => {
                    let earlier = self.sums[sums.rank as usize].replace(sums);
                    self.missing -= usize::from(earlier.is_none());
                }
                Ok(Message::Update(_)) => process.queue_for_display(&bytes),
                Ok(Message::Done) => self.done = true,
                _ => {}
            }
        }
    }

    async fn tell_all(&self, process: &impl Process, message: &Message) {
        for rank in 0..self.sums.len() {
            process.send(rank, message.encode()).await;
        }
    }

    fn power_left(&self) -> f64 {
        self.sums.iter().flatten().map(|sums| sums.unshot + sums.sent - sums.taken).sum()
    }
}
