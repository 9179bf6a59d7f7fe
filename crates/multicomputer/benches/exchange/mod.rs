//! The exchange that measures the network models: every node of a Paragon repeatedly sends to four
//! others.

use std::cell::Cell;
use std::rc::Rc;

use desim::{Simulation, Time};
use multicomputer::{Machine, Multicomputer, NetworkModel};

/// Columns of nodes, on the first rows of the machine's mesh.
pub const COLUMNS: usize = 4;
/// Rows of nodes.
pub const ROWS: usize = 14;
/// Bytes of a message, as in RR-3008.
pub const BYTES: u64 = 4096;

/// The machine of the paper.
pub fn paragon() -> Machine {
    let text = include_str!("../../../../machines/paragon-xps.json");
    Machine::from_json(text, "paragon-xps.json").expect("the committed file is valid")
}

/// The measured models, the cheapest first. `flit` is left out: it is too slow.
pub const OURS: [NetworkModel; 3] =
    [NetworkModel::Ideal, NetworkModel::LogGp, NetworkModel::Wormhole];

/// The four neighbours of a node. Rows and columns wrap around, so that every node has four and some
/// messages cross the machine.
pub fn neighbours(rank: usize) -> [usize; 4] {
    let (x, y) = (rank % COLUMNS, rank / COLUMNS);
    let at = |x: usize, y: usize| y % ROWS * COLUMNS + x % COLUMNS;
    [at(x + 1, y), at(x + COLUMNS - 1, y), at(x, y + 1), at(x, y + ROWS - 1)]
}

/// Every node sends a message to each neighbour and waits for theirs, `rounds` times. Returns the number
/// of messages read and the virtual time of the end.
pub fn exchange(model: NetworkModel, rounds: u64) -> (u64, Time) {
    let machine = paragon();
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let nodes = COLUMNS * ROWS;
    let network =
        machine.network_on(model).expect("the Paragon's file says enough for every model");
    let multicomputer = Multicomputer::with_network(&handle, &machine, nodes, network)
        .expect("the machine has enough nodes");
    let total = Rc::new(Cell::new(0));
    for rank in 0..nodes {
        let (node, total) = (multicomputer.node(rank), total.clone());
        handle.spawn(format!("node {rank}"), async move {
            let mut taken = 0;
            for round in 1..=rounds {
                for to in neighbours(rank) {
                    node.send(to, BYTES, ()).await;
                }
                while taken < 4 * round {
                    node.wait().await;
                    taken += node.received().await.len() as u64;
                }
            }
            total.set(total.get() + taken);
        });
    }
    let end = simulation.run().expect("each message that a node waits for is sent");
    (total.get(), end)
}
