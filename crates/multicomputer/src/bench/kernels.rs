//! Small programs that measure machines: ping-pong, exchange, hot spot. They run as processes on nodes.

use desim::{Simulation, Stalled, Time};

use crate::machine::{Machine, MachineError, Multicomputer};
use crate::network::{Network, Shape};
use crate::node::{Node, Rank};

/// Why a kernel did not end.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KernelError {
    /// The machine has too few nodes.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// Messages or processes wait for each other.
    #[error(transparent)]
    Stalled(#[from] Stalled),
}

/// Two nodes send a message of `bytes` back and forth, `rounds` times. Returns the total time.
///
/// # Errors
/// [`KernelError`], when the machine has too few nodes.
pub fn ping_pong(
    machine: &Machine,
    network: Box<dyn Network>,
    (one, other): (Rank, Rank),
    bytes: u64,
    rounds: u32,
) -> Result<Time, KernelError> {
    let ranks = one.max(other) + 1;
    run(machine, network, ranks, move |node| async move {
        let rank = node.rank();
        let partner = match rank {
            _ if rank == one => other,
            _ if rank == other => one,
            _ => return,
        };
        for _ in 0..rounds {
            if rank == one {
                node.send(partner, bytes, ()).await;
            }
            receive(&node, 1).await;
            if rank == other {
                node.send(partner, bytes, ()).await;
            }
        }
    })
}

/// In each of `rounds` rounds, each of `ranks` nodes sends `bytes` to four neighbours and waits for
/// theirs: the ranks one and a row before and after its own, modulo `ranks`. Returns the total time.
///
/// # Errors
/// [`KernelError`], when the machine has too few nodes.
pub fn exchange(
    machine: &Machine,
    network: Box<dyn Network>,
    ranks: usize,
    bytes: u64,
    rounds: u32,
) -> Result<Time, KernelError> {
    let row = match machine.topology().shape() {
        Shape::Mesh { width, .. } | Shape::Torus { width, .. } => width.into(),
        Shape::Crossbar { .. } | Shape::Bus { .. } => ranks.isqrt(),
    };
    let row = row % ranks.max(1);
    run(machine, network, ranks, move |node| async move {
        let rank = node.rank();
        let neighbours = [1, ranks - 1, row, ranks - row].map(|step| (rank + step) % ranks);
        let mut early = 0;
        for _ in 0..rounds {
            for to in neighbours {
                node.send(to, bytes, ()).await;
            }
            // A neighbour may be a round ahead.
            early = receive(&node, neighbours.len() - early).await;
        }
    })
}

/// All nodes but the first send `bytes` to the first one, `rounds` times without a pause. Returns the
/// time until it has read all messages.
///
/// # Errors
/// [`KernelError`], when the machine has too few nodes.
pub fn hot_spot(
    machine: &Machine,
    network: Box<dyn Network>,
    ranks: usize,
    bytes: u64,
    rounds: u32,
) -> Result<Time, KernelError> {
    run(machine, network, ranks, move |node| async move {
        if node.rank() == 0 {
            receive(&node, (ranks - 1) * rounds as usize).await;
            return;
        }
        for _ in 0..rounds {
            node.send(0, bytes, ()).await;
        }
    })
}

/// Reads at least `count` messages. Returns how many more it has read.
async fn receive(node: &Node<()>, count: usize) -> usize {
    let mut read = 0;
    while read < count {
        node.wait().await;
        read += node.received().await.len();
    }
    read - count
}

/// Runs a program on the first `ranks` nodes.
fn run<F: Future<Output = ()> + 'static>(
    machine: &Machine,
    network: Box<dyn Network>,
    ranks: usize,
    program: impl Fn(Node<()>) -> F,
) -> Result<Time, KernelError> {
    let simulation = Simulation::new();
    let multicomputer = Multicomputer::with_network(&simulation.handle(), machine, ranks, network)?;
    for rank in 0..ranks {
        let node = multicomputer.node(rank);
        simulation.handle().spawn(format!("node {rank}"), program(node));
    }
    Ok(simulation.run()?)
}
