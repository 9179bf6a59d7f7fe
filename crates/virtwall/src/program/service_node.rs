//! The program of the service node: Figure 6 of RR-3008, and the collection of §4.2.4.

use desim::{Duration, Time};

use super::process::{Process, ProgramError};
use crate::wire::{Message, Sums};

/// When the service node collects, and when it tells compute nodes to stop selecting patches.
#[derive(Clone, Copy, Debug)]
pub struct Collection {
    /// Number of compute nodes; their ranks start at 0.
    pub compute_nodes: usize,
    /// Time from the end of one collection to the next.
    pub every: Duration,
    /// Stop when less than this power is unshot or in transit, W; 0 never stops.
    pub stop_below: f64,
}

/// The service node's way to the display (Figure 6).
#[expect(async_fn_in_trait, reason = "a process stays on its own thread")]
pub trait Display {
    /// Put an update into the queue for the display.
    fn queue(&self, update: &Message);

    /// Whether the queue should get more updates before the next one is sent.
    fn wants_more(&self) -> bool;

    /// Send the next update of the queue; false if there is none.
    async fn socket_send(&self) -> bool;
}

/// No display: updates end at the service node.
pub struct NoDisplay;

impl Display for NoDisplay {
    fn queue(&self, _: &Message) {}

    fn wants_more(&self) -> bool {
        false
    }

    async fn socket_send(&self) -> bool {
        false
    }
}

/// Gather radiosity updates until a compute node announces the end; meanwhile collect energies.
///
/// # Errors
/// A message that cannot be read.
#[doc(alias = "ServiceNode")]
#[doc(alias = "Figure 6")]
pub async fn service_node(
    process: &impl Process,
    display: &impl Display,
    collection: Collection,
) -> Result<(), ProgramError> {
    let sums = vec![None; collection.compute_nodes];
    let mut node = ServiceNode { process, display, missing: sums.len(), sums, done: false };
    let mut stopped = false;
    loop {
        let next = process.now() + collection.every;
        node.receive_until(next).await?;
        node.collect().await?;
        if node.done {
            return Ok(());
        }
        // The sums are of slightly different moments, as they would be on the real machine.
        if !stopped && node.power_left() < collection.stop_below {
            stopped = true;
            node.tell_all(&Message::StopSelecting).await;
        }
    }
}

/// The service node, and what compute nodes have reported to it.
struct ServiceNode<'a, P, D> {
    process: &'a P,
    display: &'a D,
    /// Sums of the compute nodes, by rank.
    sums: Vec<Option<Sums>>,
    /// Compute nodes that have not answered yet.
    missing: usize,
    done: bool,
}

impl<P: Process, D: Display> ServiceNode<'_, P, D> {
    /// Receive until a time or the end.
    async fn receive_until(&mut self, time: Time) -> Result<(), ProgramError> {
        while !self.done && self.process.wait(Some(time)).await {
            self.receive().await?;
        }
        Ok(())
    }

    /// Ask every compute node for its sums and receive until all have answered, or the end.
    async fn collect(&mut self) -> Result<(), ProgramError> {
        if self.done {
            return Ok(());
        }
        self.sums.fill(None);
        self.missing = self.sums.len();
        self.tell_all(&Message::Collect).await;
        while !self.done && self.missing > 0 {
            self.process.wait(None).await;
            self.receive().await?;
        }
        Ok(())
    }

    /// Read what has arrived, and send radiosity updates on to the display.
    ///
    /// A service node that receives more updates than it can send collects late.
    async fn receive(&mut self) -> Result<(), ProgramError> {
        self.read_arrived().await?;
        while self.display.socket_send().await {
            if self.display.wants_more() {
                self.read_arrived().await?;
            }
        }
        Ok(())
    }

    async fn read_arrived(&mut self) -> Result<(), ProgramError> {
        for (from, message) in self.process.receive().await? {
            match message {
                Message::Sums(sums) => {
                    let earlier = self.sums[from].replace(sums);
                    self.missing -= usize::from(earlier.is_none());
                }
                Message::Update(_) => self.display.queue(&message),
                Message::Done => self.done = true,
                // Messages for compute nodes.
                _ => {}
            }
        }
        Ok(())
    }

    async fn tell_all(&self, message: &Message) {
        for rank in 0..self.sums.len() {
            self.process.send(rank, message.clone()).await;
        }
    }

    /// Power that is unshot or in transit, W.
    fn power_left(&self) -> f64 {
        self.sums.iter().flatten().map(|sums| sums.unshot + sums.sent - sums.taken).sum()
    }
}
