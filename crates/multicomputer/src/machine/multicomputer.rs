//! A running machine: its nodes and the network between them, over [`desim`].

use std::cell::RefCell;
use std::rc::Rc;

use desim::Handle;

use super::machine::{Machine, MachineError};
use crate::display::Display;
use crate::network::{Deadlock, Network};
use crate::node::{
    Activity, FullBuffers, MachineObserver, Node, NodeAccount, NodeState, Rank, Shared,
};

/// A machine whose processes send each other messages of type `M`. Clones are the same machine.
///
/// Paper: Figure 5, §4.1.
pub struct Multicomputer<M>(Rc<Shared<M>>);

impl<M> Clone for Multicomputer<M> {
    fn clone(&self) -> Multicomputer<M> {
        Multicomputer(self.0.clone())
    }
}

impl<M: 'static> Multicomputer<M> {
    /// The machine with `compute_ranks` compute processes, ranks 0 and up, one on each of the
    /// first compute nodes. The rank that follows is the service process, on the first service
    /// node.
    ///
    /// # Errors
    /// If there is no compute process, or more than the machine has compute nodes.
    pub fn new(
        handle: &Handle,
        machine: &Machine,
        compute_ranks: usize,
    ) -> Result<Multicomputer<M>, MachineError> {
        Multicomputer::with_network(handle, machine, compute_ranks, machine.network())
    }

    /// Like [`Multicomputer::new`], with a network other than the machine's own.
    ///
    /// # Errors
    /// As for [`Multicomputer::new`].
    pub fn with_network(
        handle: &Handle,
        machine: &Machine,
        compute_ranks: usize,
        network: Box<dyn Network>,
    ) -> Result<Multicomputer<M>, MachineError> {
        let nodes = machine.places(compute_ranks)?.enumerate().map(|(rank, place)| {
            let display = machine.display.as_ref().filter(|_| rank == compute_ranks);
            let room = match display.and_then(Display::room_for_mail) {
                Some(bytes) => (Some(bytes), Activity::WaitForDisplay),
                None => (machine.message_layer.buffer_bytes, Activity::WaitForRoom),
            };
            NodeState::new(handle, rank, place, machine.node_memory.as_ref(), room)
        });
        let layer = machine.message_layer.clone();
        Ok(Multicomputer(Shared::new(handle, layer, network, nodes.collect())))
    }

    /// Reports all that happens from now on to `observer`. Only the first observer counts.
    pub fn observe(&self, observer: &Rc<RefCell<dyn MachineObserver<M>>>) {
        if self.0.observer.set(Rc::clone(observer)).is_err() {
            return;
        }
        for (rank, node) in self.0.nodes.iter().enumerate() {
            let observer = Rc::clone(observer);
            node.ledger.borrow_mut().observe(move |activity, from, to| {
                observer.borrow_mut().activity(rank, activity, from, to);
            });
        }
    }

    /// The node of a process.
    ///
    /// # Panics
    /// If no process has that rank.
    pub fn node(&self, rank: Rank) -> Node<M> {
        let ranks = self.0.nodes.len();
        assert!(rank < ranks, "no rank {rank}: the ranks are 0 to {}", ranks - 1);
        Node::new(rank, self.0.clone())
    }

    /// The accounts of all nodes until now, in the order of ranks.
    pub fn accounts(&self) -> Vec<NodeAccount> {
        let now = self.0.handle.now();
        self.0.nodes.iter().map(|node| node.account(now)).collect()
    }

    /// The deadlock by full buffers that halted the simulation, if one did.
    pub fn full_buffers(&self) -> Option<FullBuffers> {
        self.0.full_buffers.borrow().clone()
    }

    /// The deadlock in the network that halted the simulation, if one did.
    pub fn deadlock(&self) -> Option<Deadlock> {
        self.0.transport.borrow().deadlock.clone()
    }
}
