//! The network models by name, from the cheapest to the most detailed.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::flit::Flit;
use super::formula::ContentionFree;
use super::ideal::Ideal;
use super::links::LinkParameters;
use super::loggp::{LogGp, LogGpParameters};
use super::network::Network;
use super::topology::Topology;
use super::wormhole::Wormhole;

/// A network model. Each one models more than the one before it, and costs more of the host's time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NetworkModel {
    /// Messages arrive at once and cost nothing.
    Ideal,
    /// Overheads, latency, gap, gap a byte and hops, without contention.
    LogGp,
    /// Worms that hold the links of their routes, message by message.
    Wormhole,
    /// Flits, buffers and virtual channels, cycle by cycle.
    Flit,
}

impl NetworkModel {
    /// All models, the cheapest first.
    pub const ALL: [NetworkModel; 4] =
        [NetworkModel::Ideal, NetworkModel::LogGp, NetworkModel::Wormhole, NetworkModel::Flit];

    /// Its name in files and arguments.
    pub fn name(self) -> &'static str {
        match self {
            NetworkModel::Ideal => "ideal",
            NetworkModel::LogGp => "loggp",
            NetworkModel::Wormhole => "wormhole",
            NetworkModel::Flit => "flit",
        }
    }
}

impl fmt::Display for NetworkModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for NetworkModel {
    type Err = String;

    fn from_str(text: &str) -> Result<NetworkModel, String> {
        NetworkModel::ALL.into_iter().find(|model| model.name() == text).ok_or_else(|| {
            let names = NetworkModel::ALL.map(NetworkModel::name).join(", ");
            format!("found \"{text}\"; expected a network model: {names}")
        })
    }
}

/// The choice of a model in a machine file or an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ModelChoice {
    /// Messages arrive at once and cost nothing.
    Ideal,
    /// LogGP with hops, without contention.
    LogGp,
    /// Worms that hold the links of their routes, message by message.
    Wormhole,
    /// Flits, buffers and virtual channels, cycle by cycle: slow.
    Flit,
    /// The cheapest of them whose time differs little from that of the next one.
    Auto,
}

impl ModelChoice {
    /// The chosen model; none for the automatic choice.
    pub fn model(self) -> Option<NetworkModel> {
        match self {
            ModelChoice::Ideal => Some(NetworkModel::Ideal),
            ModelChoice::LogGp => Some(NetworkModel::LogGp),
            ModelChoice::Wormhole => Some(NetworkModel::Wormhole),
            ModelChoice::Flit => Some(NetworkModel::Flit),
            ModelChoice::Auto => None,
        }
    }
}

/// Parameters of a machine's network.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkParameters {
    /// Parameters of the message layer. Every model but `ideal` needs them.
    pub software: Option<LogGpParameters>,
    /// Parameters of the links. The models with contention need them.
    pub links: Option<LinkParameters>,
}

impl NetworkParameters {
    /// An empty network of this model; none without the parameters that it needs.
    pub fn build(&self, model: NetworkModel, topology: &Topology) -> Option<Box<dyn Network>> {
        let software = self.software.clone();
        let links = self.links.clone();
        Some(match model {
            NetworkModel::Ideal => Box::new(ContentionFree::new(Ideal)),
            NetworkModel::LogGp => Box::new(LogGp::new(software?, topology)),
            NetworkModel::Wormhole => Box::new(Wormhole::new(software?, links?, topology)),
            NetworkModel::Flit => Box::new(Flit::new(software?, links?, topology)),
        })
    }
}
