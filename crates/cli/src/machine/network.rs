//! The argument `--network`.

use clap::Args;
use multicomputer::{Machine, NetworkModel};

#[derive(Args)]
pub struct NetworkArgument {
    /// Network model: ideal, loggp, wormhole or flit [default: the machine file's]
    #[arg(long, value_name = "MODEL")]
    network: Option<NetworkModel>,
}

impl NetworkArgument {
    /// The model asked for, or the machine file's.
    pub fn model(&self, machine: &Machine) -> NetworkModel {
        self.network.or(machine.network_model).unwrap_or(NetworkModel::LogGp)
    }
}
