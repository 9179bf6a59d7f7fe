//! The ladder of network models.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::delivery::Network;
use super::flit::Flit;
use super::formula::Foretold;
use super::ideal::Ideal;
use super::links::LinkParameters;
use super::loggp::{LogGp, LogGpParameters};
use super::wormhole::Wormhole;
use crate::topology::Topology;

/// A model of the network: each rung tells more of what happens than the one below, and costs more
/// of the host's time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rung {
    /// Messages arrive at once and cost nothing.
    Ideal,
    /// Overheads, latency, gap, gap a byte and hops, without contention.
    LogGp,
    /// Worms that hold the links of their routes, message by message.
    Wormhole,
    /// Flits, buffers and virtual channels, cycle by cycle.
    Flit,
}

impl Rung {
    /// All rungs, from the lowest.
    pub const ALL: [Rung; 4] = [Rung::Ideal, Rung::LogGp, Rung::Wormhole, Rung::Flit];

    /// Its name in files and arguments.
    pub fn name(self) -> &'static str {
        match self {
            Rung::Ideal => "ideal",
            Rung::LogGp => "loggp",
            Rung::Wormhole => "wormhole",
            Rung::Flit => "flit",
        }
    }

    /// Whether it needs to know of links.
    pub fn needs_links(self) -> bool {
        self >= Rung::Wormhole
    }
}

impl fmt::Display for Rung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Rung {
    type Err = String;

    fn from_str(text: &str) -> Result<Rung, String> {
        Rung::ALL.into_iter().find(|rung| rung.name() == text).ok_or_else(|| {
            let names = Rung::ALL.map(Rung::name).join(", ");
            format!("found \"{text}\"; expected a network model: {names}")
        })
    }
}

/// What a machine file, or an experiment, asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Model {
    /// Messages arrive at once and cost nothing.
    Ideal,
    /// LogGP with hops, without contention.
    LogGp,
    /// Worms that hold the links of their routes, message by message.
    Wormhole,
    /// Flits, buffers and virtual channels, cycle by cycle: slow.
    Flit,
    /// The cheapest of them whose time differs little from the next one's.
    Auto,
}

impl Model {
    /// The rung of the ladder; none if that is to be found out.
    pub fn rung(self) -> Option<Rung> {
        match self {
            Model::Ideal => Some(Rung::Ideal),
            Model::LogGp => Some(Rung::LogGp),
            Model::Wormhole => Some(Rung::Wormhole),
            Model::Flit => Some(Rung::Flit),
            Model::Auto => None,
        }
    }
}

/// What a machine file says of its network.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkParameters {
    /// What the message layer takes; every rung but the ideal one needs it.
    pub software: Option<LogGpParameters>,
    /// What the rungs with contention need.
    pub links: Option<LinkParameters>,
}

impl NetworkParameters {
    /// A network on a rung, with nothing under way; none without the parameters that it needs.
    pub fn build(&self, rung: Rung, topology: &Topology) -> Option<Box<dyn Network>> {
        let software = self.software.clone();
        let links = self.links.clone();
        Some(match rung {
            Rung::Ideal => Box::new(Foretold::new(Ideal)),
            Rung::LogGp => Box::new(Foretold::new(LogGp::new(software?, topology))),
            Rung::Wormhole => Box::new(Wormhole::new(software?, links?, topology)),
            Rung::Flit => Box::new(Flit::new(software?, links?, topology)),
        })
    }
}
