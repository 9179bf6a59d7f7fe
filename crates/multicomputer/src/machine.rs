//! A machine, as its file describes it, checked once at the door.

use std::fmt;

use thiserror::Error;

use crate::file::{LogGpFile, MachineFile, NetworkFile, ProcessorFile};
use crate::mesh::{Mesh, Place};
use crate::network::{LogGpParameters, NetworkModel};
use crate::processor::Processor;

/// Largest mesh, in places: beyond it a file can only be a slip.
const MOST_PLACES: u32 = 65_536;

/// A distributed-memory machine.
#[derive(Clone, Debug)]
pub struct Machine {
    /// What machine this is, for people.
    pub title: String,
    /// The processor of every node.
    pub processor: Processor,
    /// How messages travel.
    pub network: NetworkModel,
    mesh: Mesh,
    compute_nodes: usize,
    service_nodes: usize,
}

/// What cannot be meant.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MachineError {
    /// The machine's file is at fault.
    #[error("{0}")]
    File(MachineFault),
    /// More processes than nodes.
    #[error(
        "found {asked} compute processes; expected at most {available}, the compute nodes of the \
         {title}"
    )]
    TooManyProcesses {
        /// Compute processes asked for.
        asked: usize,
        /// Compute nodes there are.
        available: usize,
        /// The machine.
        title: String,
    },
    /// No process at all.
    #[error("found 0 compute processes; expected at least 1")]
    NoProcess,
}

/// What is wrong with a machine file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineFault {
    /// The file.
    pub file: String,
    /// Line and column, from 1; `None` where the fault lies in several places.
    pub line_and_column: Option<(usize, usize)>,
    /// The way to the value, such as `processor.clock.value`; empty for the file as a whole.
    pub place: String,
    /// What was found and what was expected.
    pub message: String,
}

impl fmt::Display for MachineFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some((line, column)) = self.line_and_column {
            write!(f, ":{line}:{column}")?;
        }
        if !self.place.is_empty() {
            write!(f, ": {}", self.place)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl Machine {
    /// Reads a machine file's text; `file_name` is for messages only.
    ///
    /// # Errors
    /// [`MachineError::File`], which names file, place, value and what was expected.
    pub fn from_json(text: &str, file_name: &str) -> Result<Machine, MachineError> {
        read(text).and_then(validate).map_err(|fault| {
            MachineError::File(MachineFault { file: file_name.to_owned(), ..fault })
        })
    }

    /// The mesh on which the nodes stand.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Nodes that compute.
    pub fn compute_nodes(&self) -> usize {
        self.compute_nodes
    }

    /// Nodes that collect results and control the computation.
    pub fn service_nodes(&self) -> usize {
        self.service_nodes
    }

    /// Where the processes of a run stand: compute process r on place r, since compute nodes fill
    /// the mesh row by row, and last the service process, on the place after all compute nodes.
    pub(crate) fn places(
        &self,
        compute_ranks: usize,
    ) -> Result<impl Iterator<Item = Place>, MachineError> {
        if compute_ranks == 0 {
            return Err(MachineError::NoProcess);
        }
        if compute_ranks > self.compute_nodes {
            return Err(MachineError::TooManyProcesses {
                asked: compute_ranks,
                available: self.compute_nodes,
                title: self.title.clone(),
            });
        }
        let numbers = (0..compute_ranks).chain([self.compute_nodes]);
        Ok(numbers.filter_map(|number| self.mesh.place(number)))
    }
}

/// The file's text as its raw structure, with serde's complaint and its place.
fn read(text: &str) -> Result<MachineFile, MachineFault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let file = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let place = error.path().to_string();
        fault(if place == "." { String::new() } else { place }, error.inner())
    })?;
    json.end().map_err(|error| fault(String::new(), &error))?;
    Ok(file)
}

fn fault(place: String, error: &serde_json::Error) -> MachineFault {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    // serde_json appends the position to its message; it is told apart here.
    let suffix = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&suffix).unwrap_or(&message).to_owned();
    let line_and_column = (line > 0).then_some((line, column));
    MachineFault { file: String::new(), line_and_column, place, message }
}

/// The machine, if its nodes have room on its mesh.
fn validate(file: MachineFile) -> Result<Machine, MachineFault> {
    let (width, height) = (file.mesh.width.value.get(), file.mesh.height.value.get());
    let (compute, service) = (file.compute_nodes.value.get(), file.service_nodes.value.get());
    let places = u32::from(width) * u32::from(height);
    let nodes = u32::from(compute) + u32::from(service);
    let found = format!("found {width} × {height} = {places} places");
    let refuse = |message| {
        let (file, place) = (String::new(), "mesh".to_owned());
        Err(MachineFault { file, line_and_column: None, place, message })
    };
    if places > MOST_PLACES {
        return refuse(format!("{found}; expected at most {MOST_PLACES}"));
    }
    if places < nodes {
        return refuse(format!(
            "{found}; expected at least {nodes}, for {compute} compute nodes and {service} service \
             nodes"
        ));
    }
    let hop_time = file.mesh.hop_time.value.duration();
    Ok(Machine {
        title: file.title,
        processor: processor(file.processor),
        network: match file.network {
            NetworkFile::LogGp(parameters) => NetworkModel::LogGp(loggp(&parameters, hop_time)),
            NetworkFile::Ideal => NetworkModel::Ideal,
        },
        mesh: Mesh::new(width, height),
        compute_nodes: compute.into(),
        service_nodes: service.into(),
    })
}

fn processor(file: ProcessorFile) -> Processor {
    let cycles = file.operations.into_iter().map(|(name, cycles)| (name, cycles.value.si));
    Processor { clock: file.clock.value.si, scale: file.scale.value.0, cycles: cycles.collect() }
}

fn loggp(file: &LogGpFile, hop_time: desim::Duration) -> LogGpParameters {
    LogGpParameters {
        send_overhead: file.send_overhead.value.duration(),
        latency: file.latency.value.duration(),
        hop_time,
        receive_overhead: file.receive_overhead.value.duration(),
        gap: file.gap.value.duration(),
        bandwidth: file.bandwidth.value.si,
    }
}
