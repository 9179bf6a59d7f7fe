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

/// What a model leaves out of the times of several messages at once; `None` if it models links.
pub fn caveat(model: NetworkModel, machine: &Machine) -> Option<String> {
    let lacks = match model {
        NetworkModel::Ideal => {
            "no cost and no contention: times are those of the message layer alone, at most"
        }
        NetworkModel::LogGp => {
            "no contention in links: messages share nothing but the ports of their nodes, so that several at a time \
             can take longer than it says"
        }
        NetworkModel::Wormhole | NetworkModel::Flit => return None,
    };
    let links = machine.parameters.links.is_some() && machine.parameters.software.is_some();
    let other = if links { "; --network wormhole models links" } else { "" };
    Some(format!("Model {model} has {lacks}{other}."))
}
