//! The fields of a machine file. [`crate::Machine`] is the checked machine made from them.

use std::collections::BTreeMap;
use std::num::{NonZeroU8, NonZeroU16};
use std::sync::LazyLock;

use config::{Bandwidth, Bytes, Cycles, Frequency, Quantity, Time, schema};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

use crate::display::DisplayFile;
use crate::network::ModelChoice;
use crate::node::{MessageLayerFile, StartUpFile};
use crate::sourced::{Positive, Sourced};

/// A distributed-memory machine: compute nodes and service nodes on a mesh, a torus, a crossbar or a
/// bus. Every number says how it is known and where it comes from.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a machine")]
#[schemars(title = "Virtwall machine")]
pub(crate) struct MachineFile {
    /// Where editors find the schema of this file.
    #[serde(rename = "$schema", default)]
    pub(crate) _schema: Option<String>,
    /// A machine of which this file says only what differs: each of its fields takes the place of
    /// that one's, objects field by field; null takes a field away.
    #[serde(default)]
    pub(crate) extends: Option<String>,
    /// What machine this is, for people.
    pub(crate) title: String,
    /// A mesh; one of "mesh", "torus", "crossbar" and "bus" must be there. Compute nodes fill its
    /// places row by row in the order of their ranks; service nodes stand on those that follow.
    #[serde(default)]
    pub(crate) mesh: Option<MeshFile>,
    /// A mesh whose rows and columns of three places or more are closed to rings; messages take the
    /// shorter way. Without virtual channels it can deadlock.
    #[serde(default)]
    pub(crate) torus: Option<MeshFile>,
    /// A switch that joins all nodes: a message takes a link to it and a link from it.
    #[serde(default)]
    pub(crate) crossbar: Option<HubFile>,
    /// A bus: all messages take one link in common, besides a link onto it and a link off it.
    #[serde(default)]
    pub(crate) bus: Option<HubFile>,
    /// Nodes that compute.
    pub(crate) compute_nodes: Sourced<NonZeroU16>,
    /// Nodes that collect results and control the computation.
    pub(crate) service_nodes: Sourced<NonZeroU16>,
    /// The processor of every node.
    pub(crate) processor: ProcessorFile,
    /// The memory of every node; without it memory costs nothing and never fills.
    #[serde(default)]
    pub(crate) node_memory: Option<NodeMemoryFile>,
    /// How messages travel.
    pub(crate) network: NetworkFile,
    /// What the message layer of a node does besides the overheads of the network's parameters; what
    /// is left out of it costs nothing.
    #[serde(default)]
    pub(crate) message_layer: MessageLayerFile,
    /// The way of updates from the service node to a display; without it they end at the service node and
    /// cost nothing more.
    #[serde(default)]
    pub(crate) display: Option<DisplayFile>,
    /// How nodes read their input and make themselves ready; without it that takes no time.
    #[serde(default)]
    pub(crate) start_up: Option<StartUpFile>,
    /// Measurements of the real machine, to compare with simulated ones.
    #[serde(default)]
    pub(crate) published: PublishedFile,
}

/// Published measurements of messages between two neighbours.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields, expecting = "an object of published measurements")]
pub(crate) struct PublishedFile {
    /// Time of the shortest message, from sender to receiver.
    pub(crate) latency: Option<Sourced<Quantity<Time>>>,
    /// Bytes a second of the longest messages.
    pub(crate) bandwidth: Option<Sourced<Quantity<Bandwidth>>>,
}

/// A two-dimensional mesh or torus; messages go along the row first, then along the column.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a mesh")]
pub(crate) struct MeshFile {
    /// Places in a row.
    pub(crate) width: Sourced<NonZeroU16>,
    /// Rows.
    pub(crate) height: Sourced<NonZeroU16>,
    /// Time that the head of a message takes from one router to the next.
    pub(crate) hop_time: Sourced<Quantity<Time>>,
}

/// A crossbar or a bus.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a crossbar or a bus")]
pub(crate) struct HubFile {
    /// Time that the head of a message takes over a link.
    pub(crate) hop_time: Sourced<Quantity<Time>>,
}

/// What operations cost: cycles × scale / clock.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a processor")]
pub(crate) struct ProcessorFile {
    /// Cycles a second.
    pub(crate) clock: Sourced<Quantity<Frequency>>,
    /// Factor on all cycle counts: compiled code is slower than operations counted by hand.
    pub(crate) scale: Sourced<Positive>,
    /// Cycles of each operation that the kernels count.
    pub(crate) operations: BTreeMap<String, Sourced<Quantity<Cycles>>>,
    /// Data caches. Without them misses cost nothing but what the cycles of the operations hold already.
    pub(crate) caches: Option<CachesFile>,
}

/// The caches between a processor and its memory.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes caches")]
pub(crate) struct CachesFile {
    /// The one nearest to the processor.
    pub(crate) primary: CacheFile,
    /// The one behind it.
    pub(crate) secondary: Option<CacheFile>,
    /// The translation look-aside buffer. Without one all pages' addresses are known.
    pub(crate) translations: Option<TranslationsFile>,
}

/// The addresses of pages that a processor knows. Each touch of a page that is not among them is a miss;
/// the least recently used one makes room.
#[derive(Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object that describes a translation look-aside buffer"
)]
pub(crate) struct TranslationsFile {
    /// Pages whose addresses it holds.
    pub(crate) entries: Sourced<NonZeroU16>,
    /// Bytes of a page.
    pub(crate) page: Sourced<Quantity<Bytes>>,
    /// What a miss takes.
    pub(crate) miss_time: Sourced<Quantity<Time>>,
}

/// A data cache.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a cache")]
pub(crate) struct CacheFile {
    /// Bytes that it holds.
    pub(crate) size: Sourced<Quantity<Bytes>>,
    /// Bytes that a miss fetches.
    pub(crate) line: Sourced<Quantity<Bytes>>,
    /// Lines among which the least recently used one makes room: 1 is direct-mapped.
    pub(crate) ways: Sourced<NonZeroU16>,
    /// By how much a miss is slower than a hit, when the next level has the line.
    pub(crate) miss_time: Sourced<Quantity<Time>>,
}

/// Memory of a node. What programs keep beyond its capacity is paged out, least recently used first,
/// and costs time when it is used again: a fault a burst, and its bytes at the bandwidth.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes memory")]
pub(crate) struct NodeMemoryFile {
    /// Memory of a node in all.
    pub(crate) installed: Sourced<Quantity<Bytes>>,
    /// What the operating system takes of it.
    pub(crate) system: Sourced<Quantity<Bytes>>,
    /// What is set aside for messages that have arrived and were not read; what exceeds it takes from
    /// the program's share.
    pub(crate) message_buffers: Sourced<Quantity<Bytes>>,
    /// What one fault brings in.
    pub(crate) burst: Sourced<Quantity<Bytes>>,
    /// Time of a fault until its first byte comes.
    pub(crate) fault_time: Sourced<Quantity<Time>>,
    /// Bytes a second at which the others follow.
    pub(crate) bandwidth: Sourced<Quantity<Bandwidth>>,
    /// Bytes of each thing that programs keep.
    pub(crate) sizes: BTreeMap<String, Sourced<Quantity<Bytes>>>,
}

/// The network: which model of it tells when messages arrive, and what the models need to know.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a network")]
pub(crate) struct NetworkFile {
    /// The model, unless an experiment or an argument asks for another one.
    pub(crate) model: ModelChoice,
    /// The message layer, after LogGP. Only the model "ideal" does without.
    #[serde(default)]
    pub(crate) parameters: Option<LogGpFile>,
    /// The links. The models "wormhole", "flit" and "auto" need them.
    #[serde(default)]
    pub(crate) links: Option<LinksFile>,
}

/// Parameters of LogGP. A message of n bytes, alone on the network, is read after
/// send_overhead + latency + hops × hop_time + n / bandwidth + receive_overhead.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object of LogGP's parameters")]
pub(crate) struct LogGpFile {
    /// o: time of the sending processor for a message.
    pub(crate) send_overhead: Sourced<Quantity<Time>>,
    /// L: time between the two overheads, without hops.
    pub(crate) latency: Sourced<Quantity<Time>>,
    /// o: time of the receiving processor for a message.
    pub(crate) receive_overhead: Sourced<Quantity<Time>>,
    /// g: least time from the end of one injection of a node to the start of its next.
    pub(crate) gap: Sourced<Quantity<Time>>,
    /// 1/G: bytes a second at which a node injects a message.
    pub(crate) bandwidth: Sourced<Quantity<Bandwidth>>,
}

/// The links and the routers that they join.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes links")]
pub(crate) struct LinksFile {
    /// Bytes a second over a link, one way, and between a node and its router; at least the
    /// bandwidth of the message layer.
    pub(crate) bandwidth: Sourced<Quantity<Bandwidth>>,
    /// What crosses a link in one cycle, in whole bytes.
    pub(crate) flit: Sourced<Quantity<Bytes>>,
    /// Flits that a router keeps of what comes in by a virtual channel.
    pub(crate) buffer_flits: Sourced<NonZeroU16>,
    /// Virtual channels a link.
    pub(crate) virtual_channels: Sourced<NonZeroU8>,
    /// Cycles in which a router finds the way of a head at the front of its buffer, part of the time of a hop;
    /// 0 if left out. This and the next two are of the model `flit`.
    #[serde(default)]
    pub(crate) routing_cycles: Option<Sourced<u8>>,
    /// Cycles from when a head gets a virtual channel until it can leave, part of the time of a hop; 0 if
    /// left out. A channel carries nothing meanwhile, unless it has other virtual channels.
    #[serde(default)]
    pub(crate) allocation_cycles: Option<Sourced<u8>>,
    /// Cycles from when a flit leaves a buffer until its room can be used again; 1 if left out.
    #[serde(default)]
    pub(crate) credit_cycles: Option<Sourced<NonZeroU8>>,
}

/// The fields of a machine file, as a schema without references.
pub(crate) static FIELDS: LazyLock<Value> = LazyLock::new(schema::of::<MachineFile>);

/// The JSON Schema of a machine file. One that extends another need not say everything.
pub fn machine_schema() -> Value {
    let mut schema = schemars::schema_for!(MachineFile).to_value();
    if let Some(schema) = schema.as_object_mut()
        && let Some(required) = schema.remove("required")
    {
        let either = serde_json::json!([{ "required": required }, { "required": ["extends"] }]);
        schema.insert("anyOf".to_owned(), either);
    }
    schema
}
