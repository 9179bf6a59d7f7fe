//! Start-up: all nodes read the same file at once through the I/O nodes, and make themselves ready.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::num::NonZeroU16;

use desim::{Duration, Time};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::file::MachineFault;
use crate::file::without_repetition;
use crate::file::{self, Bandwidth, Bytes, Cycles, Quantity, Sourced, whole_bytes};

/// A disk's sector, bytes: shorter requests can only be a slip.
const SECTOR: u64 = 512;

/// How nodes read their input. A file lies on all I/O nodes in turn, a request's length on each; every
/// node reads it from its beginning, one request after the other, and every I/O node serves one request
/// at a time, first come, first served, the lower rank first.
///
/// The way over the network is not counted, and an I/O node keeps nothing of what it has read.
#[derive(Clone, Debug, PartialEq)]
pub struct StartUp {
    /// Nodes with disks, at least 1.
    pub io_nodes: usize,
    /// Bytes a second of the disks of one I/O node.
    pub bandwidth: f64,
    /// Time of a request until its first byte comes.
    pub access_time: Duration,
    /// Bytes of one request, at least a sector.
    pub request: u64,
    /// Cycles of the steps of initialisation, by name.
    pub cycles: BTreeMap<String, f64>,
}

/// How a node came to its input.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// When it had read all.
    pub done: Time,
    /// How long its requests waited for others at I/O nodes.
    pub waited: Duration,
}

impl StartUp {
    /// Time in which an I/O node serves a request of so many bytes.
    pub fn service(&self, bytes: u64) -> Duration {
        self.access_time + Duration::from_seconds_f64(bytes as f64 / self.bandwidth)
    }

    /// All of `nodes` read a file of so many bytes, from time zero on; by rank.
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

/// Start-up, as a machine file has it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes the start-up")]
pub(crate) struct StartUpFile {
    /// Nodes with disks, over which files are spread.
    io_nodes: Sourced<NonZeroU16>,
    /// Bytes a second of the disks of one I/O node.
    bandwidth: Sourced<Quantity<Bandwidth>>,
    /// Time of a request until its first byte comes.
    access_time: Sourced<Quantity<file::Time>>,
    /// What a node asks for at a time, and what lies on one I/O node before the next one follows.
    request: Sourced<Quantity<Bytes>>,
    /// Cycles of each step in which a node makes itself ready.
    #[serde(deserialize_with = "without_repetition")]
    operations: BTreeMap<String, Sourced<Quantity<Cycles>>>,
}

impl StartUpFile {
    pub(crate) fn check(self) -> Result<StartUp, MachineFault> {
        let request = whole_bytes("start_up.request", &self.request)?;
        if request < SECTOR {
            let message = format!("found {request} B; expected at least {SECTOR} B");
            return Err(MachineFault::at("start_up.request.value", message));
        }
        let cycles = self.operations.into_iter().map(|(name, cycles)| (name, cycles.value.si));
        Ok(StartUp {
            io_nodes: self.io_nodes.value.get().into(),
            bandwidth: self.bandwidth.value.si,
            access_time: self.access_time.value.duration(),
            request,
            cycles: cycles.collect(),
        })
    }
}
