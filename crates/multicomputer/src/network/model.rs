//! Which rung of the ladder a machine's network is.

use super::delivery::Network;
use super::ideal::Ideal;
use super::loggp::{LogGp, LogGpParameters};
use crate::mesh::Mesh;

/// Which network a machine has.
#[derive(Clone, Debug, PartialEq)]
pub enum NetworkModel {
    /// LogGP with hops.
    LogGp(LogGpParameters),
    /// Messages cost nothing.
    Ideal,
}

impl NetworkModel {
    /// A network of this model, with nothing under way.
    pub fn build(&self, mesh: &Mesh) -> Box<dyn Network> {
        match self {
            NetworkModel::LogGp(parameters) => Box::new(LogGp::new(parameters.clone(), mesh)),
            NetworkModel::Ideal => Box::new(Ideal),
        }
    }
}
