//! What a distributed-memory machine costs: its processors, its mesh, its message layer.
//!
//! Knows nothing of patches, masks or light: an operation is a name with a price, a message a
//! number of bytes. A [`Machine`] is what a file in `machines/` says, checked once; a
//! [`Multicomputer`] is such a machine running over [`desim`], whose processes each hold a
//! [`Node`].
//!
//! Contention on links would be one more [`Network`]; memory and disks would be further costs of a
//! [`Node`].

mod account;
mod file;
mod machine;
mod mesh;
mod multicomputer;
mod network;
mod node;
mod processor;
pub mod quantity;
mod sourced;

pub use account::NodeAccount;
pub use file::machine_schema;
pub use machine::{Machine, MachineError, MachineFault};
pub use mesh::{Link, Mesh, Place, Position};
pub use multicomputer::Multicomputer;
pub use network::{Delivery, Ideal, LogGp, LogGpParameters, Network, NetworkModel};
pub use node::{Node, Rank};
pub use processor::Processor;
