//! A machine as its file describes it. All its numbers are checked when it is made.

use config::{Bytes, Document, Fault, Place as Field, Quantity, read, refuse_unknown_keys};
use serde_json::Value;
use thiserror::Error;

use super::caches as cache;
use super::file::{FIELDS, MachineFile, NodeMemoryFile, ProcessorFile};
use super::network::network;
use crate::display::{Display, DisplayFile};
use crate::network::{Network, NetworkModel, NetworkParameters, Place, Shape, Topology};
use crate::node::{MessageLayer, NodeMemory, Processor, StartUp, StartUpFile};
use crate::sourced::Sourced;

/// Largest number of places of a network; more is taken for a mistake in the file.
const MOST_PLACES: u32 = 65_536;
/// Largest size of one thing in a node's memory, bytes, so that sums of sizes do not overflow.
const LARGEST_THING: u64 = 1_000_000_000;

/// A distributed-memory machine.
#[derive(Clone, Debug)]
pub struct Machine {
    /// What machine this is, for people.
    pub title: String,
    /// The processor of every node.
    pub processor: Processor,
    /// The memory of every node; none where it is not modelled.
    pub node_memory: Option<NodeMemory>,
    /// What its network needs to know on any model.
    pub parameters: NetworkParameters,
    /// The model of its network that the file chooses; none if that is left to be found out.
    pub network_model: Option<NetworkModel>,
    /// What its nodes' message layer does besides LogGP's overheads, on every model.
    pub message_layer: MessageLayer,
    /// The way of what goes from the service node to a display; none where it is not modelled.
    pub display: Option<Display>,
    /// How nodes read their input; none where it is not modelled.
    pub start_up: Option<StartUp>,
    /// What has been measured on the real machine.
    pub published: Published,
    topology: Topology,
    compute_nodes: usize,
    service_nodes: usize,
}

/// Published measurements of messages between two neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Published {
    /// Time of the shortest message, from sender to receiver.
    pub latency: Option<desim::Duration>,
    /// Bytes a second of the longest messages.
    pub bandwidth: Option<f64>,
}

/// What cannot be meant.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MachineError {
    /// The machine's file is at fault.
    #[error("{0}")]
    File(Fault),
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
    /// The machine's file does not say enough for a model of its network.
    #[error("the {title} has no \"network.{missing}\", which its network needs as \"{model}\"")]
    Network {
        /// The model asked for.
        model: NetworkModel,
        /// The field that is missing.
        missing: &'static str,
        /// The machine.
        title: String,
    },
    /// No process at all.
    #[error("found 0 compute processes; expected at least 1")]
    NoProcess,
}

impl Machine {
    /// Reads a machine file's text; `file_name` is for messages only.
    ///
    /// # Errors
    /// [`MachineError::File`], which names file, place, value and what was expected.
    pub fn from_json(text: &str, file_name: &str) -> Result<Machine, MachineError> {
        let document = Document::parse(file_name, text.to_owned()).map_err(MachineError::File)?;
        Machine::of(&document.value).map_err(|fault| MachineError::File(document.locate(fault)))
    }

    /// Reads what a machine file says, with all that it extends.
    ///
    /// # Errors
    /// The field at fault, what was found and what was expected. The caller adds the name of the file.
    pub fn of(file: &Value) -> Result<Machine, Fault> {
        refuse_unknown_keys(&FIELDS, file)?;
        validate(read(file)?)
    }

    /// How the nodes are joined.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The machine's network with nothing under way, on the model that its file chooses, or on the
    /// lowest one with costs where the choice is left open.
    pub fn network(&self) -> Box<dyn Network> {
        let built = self
            .parameters
            .build(self.network_model.unwrap_or(NetworkModel::LogGp), &self.topology);
        built.expect("a file that lacks what its model needs was refused")
    }

    /// The machine's network with nothing under way, on a model of the caller's choice.
    ///
    /// # Errors
    /// [`MachineError::Network`] when the machine's file does not say enough for it.
    pub fn network_on(&self, model: NetworkModel) -> Result<Box<dyn Network>, MachineError> {
        self.parameters.build(model, &self.topology).ok_or_else(|| {
            let missing = if self.parameters.software.is_none() { "parameters" } else { "links" };
            MachineError::Network { model, missing, title: self.title.clone() }
        })
    }

    /// Nodes that compute.
    pub fn compute_nodes(&self) -> usize {
        self.compute_nodes
    }

    /// Nodes that collect results and control the computation.
    pub fn service_nodes(&self) -> usize {
        self.service_nodes
    }

    /// Compute nodes and service nodes.
    pub fn nodes(&self) -> usize {
        self.compute_nodes + self.service_nodes
    }

    /// Where the processes of a run stand: compute process r on place r, since compute nodes fill
    /// the places row by row, and last the service process, on the place after all compute nodes.
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
        Ok(numbers.filter_map(|number| self.topology.place(number)))
    }
}

/// The machine, if its nodes have room on its network and that is fully described.
fn validate(file: MachineFile) -> Result<Machine, Fault> {
    if let Some(base) = &file.extends {
        let message = format!("found \"{base}\"; expected a whole machine, with that one's fields");
        return refuse("extends", message);
    }
    let (shape, hop_time) = shape(&file)?;
    let node_memory = file.node_memory.as_ref().map(node_memory).transpose()?;
    let (title, processor) = (file.title, processor(file.processor)?);
    let (model, parameters) = network(&file.network, hop_time)?;
    let message_layer = file.message_layer.check()?;
    agree(node_memory.as_ref(), &message_layer)?;
    let display = file.display.as_ref().map(DisplayFile::check).transpose()?;
    let start_up = file.start_up.map(StartUpFile::check).transpose()?;
    let published = Published {
        latency: file.published.latency.map(|latency| latency.duration()),
        bandwidth: file.published.bandwidth.map(|bandwidth| bandwidth.si()),
    };
    Ok(Machine {
        title,
        processor,
        node_memory,
        parameters,
        network_model: model,
        message_layer,
        display,
        start_up,
        published,
        topology: Topology::new(shape),
        compute_nodes: file.compute_nodes.value.get().into(),
        service_nodes: file.service_nodes.value.get().into(),
    })
}

fn refuse<T>(place: &str, message: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::at(Field::of(place), message))
}

/// How the nodes are joined, and the time of a hop.
fn shape(file: &MachineFile) -> Result<(Shape, desim::Duration), Fault> {
    let (compute, service) = (file.compute_nodes.value.get(), file.service_nodes.value.get());
    let nodes = u32::from(compute) + u32::from(service);
    let mut found = Vec::new();
    for (name, grid) in [("mesh", &file.mesh), ("torus", &file.torus)] {
        let Some(grid) = grid else { continue };
        let (width, height) = (grid.width.value.get(), grid.height.value.get());
        let places = u32::from(width) * u32::from(height);
        let text = format!("found {width} × {height} = {places} places");
        if places > MOST_PLACES {
            return refuse(name, format!("{text}; expected at most {MOST_PLACES}"));
        }
        if places < nodes {
            let what = format!("for {compute} compute nodes and {service} service nodes");
            return refuse(name, format!("{text}; expected at least {nodes}, {what}"));
        }
        let shape = match name {
            "mesh" => Shape::Mesh { width, height },
            _ => Shape::Torus { width, height },
        };
        found.push((name, shape, grid.hop_time.duration()));
    }
    let hubs = [
        ("crossbar", &file.crossbar, Shape::Crossbar { places: nodes }),
        ("bus", &file.bus, Shape::Bus { places: nodes }),
    ];
    for (name, hub, shape) in hubs {
        let hub = hub.as_ref();
        found.extend(hub.map(|hub| (name, shape, hub.hop_time.duration())));
    }
    match found[..] {
        [(_, shape, hop_time)] => Ok((shape, hop_time)),
        [] => refuse("", "no \"mesh\", \"torus\", \"crossbar\" or \"bus\"; expected one of them"),
        [_, (name, ..), ..] => {
            refuse(name, format!("found besides \"{}\"; expected one of them", found[0].0))
        }
    }
}

fn processor(file: ProcessorFile) -> Result<Processor, Fault> {
    let cycles = file.operations.into_iter().map(|(name, cycles)| (name, cycles.si()));
    let translations = file.caches.as_ref().and_then(|caches| caches.translations.as_ref());
    Ok(Processor {
        translations: translations.map(cache::translations).transpose()?,
        clock: file.clock.si(),
        scale: file.scale.value.0,
        cycles: cycles.collect(),
        caches: file.caches.as_ref().map_or(Ok(Vec::new()), cache::levels)?,
    })
}

/// The memory of a node, if the operating system leaves some.
fn node_memory(file: &NodeMemoryFile) -> Result<NodeMemory, Fault> {
    let bytes = |size: &Sourced<Quantity<Bytes>>| size.si().round() as u64;
    let (installed, system) = (bytes(&file.installed), bytes(&file.system));
    if system >= installed {
        let message =
            format!("found {system} B of {installed} B; expected less, so that some is left");
        return refuse("node_memory.system.value", message);
    }
    let buffers = bytes(&file.message_buffers);
    if buffers >= installed - system {
        let message = format!(
            "found {installed} B; expected more than {} B, so that some is left for the program: {system} B are \
             the system's and {buffers} B message buffers",
            system.saturating_add(buffers)
        );
        return refuse("node_memory.installed.value", message);
    }
    let burst = bytes(&file.burst);
    if burst == 0 {
        return refuse("node_memory.burst.value", "found 0 B; expected at least 1 B");
    }
    if let Some((name, size)) = file.sizes.iter().find(|(_, s)| bytes(s) > LARGEST_THING) {
        let found = format!("found {} B; expected at most 1 GB", size.si());
        return refuse(&format!("node_memory.sizes.{name}.value"), found);
    }
    let sizes = file.sizes.iter().map(|(name, size)| (name.clone(), bytes(size)));
    Ok(NodeMemory {
        available: installed - system,
        message_buffers: buffers,
        burst,
        fault_time: file.fault_time.duration(),
        bandwidth: file.bandwidth.si(),
        sizes: sizes.collect(),
    })
}

/// What is set aside for messages in memory is what the message layer has for them.
fn agree(memory: Option<&NodeMemory>, layer: &MessageLayer) -> Result<(), Fault> {
    let (Some(memory), Some(buffers)) = (memory, layer.buffer_bytes) else { return Ok(()) };
    if memory.message_buffers == buffers {
        return Ok(());
    }
    let message = format!("found {buffers} B; expected {} B", memory.message_buffers);
    refuse("message_layer.buffers.value", message + ", as \"node_memory.message_buffers\" says")
}
