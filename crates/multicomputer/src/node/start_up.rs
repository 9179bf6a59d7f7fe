//! Start-up: all nodes read the same file at once through the I/O nodes, then initialise.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::num::NonZeroU16;

use config::{Bandwidth, Bytes, Cycles, Fault, Place, Quantity};
use desim::{Duration, Time};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::sourced::{Sourced, whole_bytes};

/// A disk's sector, bytes: a shorter request must be a mistake.
const SECTOR: u64 = 512;

/// How nodes read their input. A file is striped over all I/O nodes, in stripes of one request. Every
/// node reads it from the beginning, one request after the other. Every I/O node serves one request at a
/// time, first come, first served, the lower rank first.
///
/// Transfers over the network are not counted, and I/O nodes cache nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct StartUp {
    /// Nodes with disks, at least 1.
    pub io_nodes: usize,
    /// Bytes a second of the disks of one I/O node.
    pub bandwidth: f64,
    /// Time of a request until its first byte is read.
    pub access_time: Duration,
    /// Bytes of one request, at least a sector.
    pub request: u64,
    /// Cycles of the steps of initialisation, by name.
    pub cycles: BTreeMap<String, f64>,
}

/// How a node read its input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// When it had read everything.
    pub done: Time,
    /// How long its requests waited at I/O nodes for requests of others.
    pub waited: Duration,
}

impl StartUp {
    /// Time in which an I/O node serves a request of `bytes`.
    pub fn service(&self, bytes: u64) -> Duration {
        self.access_time + Duration::from_seconds_f64(bytes as f64 / self.bandwidth)
    }

    /// Lets `nodes` nodes read a file of `bytes` from time zero on. Returns one entry a rank.
    pub fn read(&self, nodes: usize, bytes: u64) -> Vec<Reading> {
        let requests = bytes.div_ceil(self.request);
        let mut readings = vec![Reading::default(); nodes];
        let mut free = vec![Time::ZERO; self.io_nodes];
        let mut asked: BinaryHeap<_> = (0..nodes)
            .filter(|_| requests > 0)
            .map(|rank| Reverse((Time::ZERO, rank, 0)))
            .collect();
        while let Some(Reverse((asks, rank, number))) = asked.pop() {
            let io_node = &mut free[(number % self.io_nodes as u64) as usize];
            let begins = asks.max(*io_node);
            let length = self.request.min(bytes - number * self.request);
            *io_node = begins + self.service(length);
            readings[rank].waited += begins - asks;
            readings[rank].done = *io_node;
            if number + 1 < requests {
                asked.push(Reverse((*io_node, rank, number + 1)));
            }
        }
        readings
    }
}

/// Start-up in a machine file.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes the start-up")]
pub(crate) struct StartUpFile {
    /// Nodes with disks, over which files are striped.
    io_nodes: Sourced<NonZeroU16>,
    /// Bytes a second of the disks of one I/O node.
    bandwidth: Sourced<Quantity<Bandwidth>>,
    /// Time of a request until its first byte is read.
    access_time: Sourced<Quantity<config::Time>>,
    /// Bytes of a request, and of a stripe on one I/O node.
    request: Sourced<Quantity<Bytes>>,
    /// Cycles of each step of a node's initialisation.
    operations: BTreeMap<String, Sourced<Quantity<Cycles>>>,
}

impl StartUpFile {
    pub(crate) fn check(self) -> Result<StartUp, Fault> {
        let request = whole_bytes("start_up.request", &self.request)?;
        if request < SECTOR {
            let message = format!("found {request} B; expected at least {SECTOR} B");
            return Err(Fault::at(Place::of("start_up.request.value"), message));
        }
        let cycles = self.operations.into_iter().map(|(name, cycles)| (name, cycles.si()));
        Ok(StartUp {
            io_nodes: self.io_nodes.value.get().into(),
            bandwidth: self.bandwidth.si(),
            access_time: self.access_time.duration(),
            request,
            cycles: cycles.collect(),
        })
    }
}
