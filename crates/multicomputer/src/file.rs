//! A machine file as it stands on disk. [`crate::Machine`] is what comes of it.

use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroU16;

use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor};

use crate::sourced::{Bandwidth, Cycles, Frequency, Positive, Quantity, Sourced, Time};

/// A distributed-memory machine: compute nodes and service nodes on a two-dimensional mesh. Every
/// number says how it is known and where it comes from.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a machine")]
#[schemars(title = "Virtwall machine")]
pub(crate) struct MachineFile {
    /// Where editors find the schema of this file.
    #[serde(rename = "$schema", default)]
    pub(crate) _schema: Option<String>,
    /// What machine this is, for people.
    pub(crate) title: String,
    /// The mesh. Compute nodes fill it row by row in the order of their ranks; service nodes stand
    /// on the places that follow.
    pub(crate) mesh: MeshFile,
    /// Nodes that compute.
    pub(crate) compute_nodes: Sourced<NonZeroU16>,
    /// Nodes that collect results and control the computation.
    pub(crate) service_nodes: Sourced<NonZeroU16>,
    /// The processor of every node.
    pub(crate) processor: ProcessorFile,
    /// How messages travel.
    pub(crate) network: NetworkFile,
}

/// A two-dimensional mesh; messages go along the row first, then along the column.
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

/// What operations cost: cycles × scale / clock.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a processor")]
pub(crate) struct ProcessorFile {
    /// Cycles a second.
    pub(crate) clock: Sourced<Quantity<Frequency>>,
    /// Factor on all cycle counts: compiled code is slower than operations counted by hand.
    pub(crate) scale: Sourced<Positive>,
    /// Cycles of each operation that the kernels count.
    #[serde(deserialize_with = "without_repetition")]
    pub(crate) operations: BTreeMap<String, Sourced<Quantity<Cycles>>>,
}

/// A model of the network.
#[derive(Deserialize, JsonSchema)]
#[serde(tag = "model", content = "parameters", rename_all = "lowercase", deny_unknown_fields)]
pub(crate) enum NetworkFile {
    /// LogGP with hops, without contention.
    LogGp(LogGpFile),
    /// Messages arrive at once and cost nothing.
    Ideal,
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

/// The JSON Schema of a machine file.
pub fn machine_schema() -> serde_json::Value {
    schemars::schema_for!(MachineFile).to_value()
}

/// Reads a map and refuses a key that stands in it twice, which serde's own maps let pass.
fn without_repetition<'de, D, T>(deserializer: D) -> Result<BTreeMap<String, T>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    struct Entries<T>(std::marker::PhantomData<T>);

    impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
        type Value = BTreeMap<String, T>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("operations by name")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
            let mut map = BTreeMap::new();
            while let Some(key) = entries.next_key::<String>()? {
                if map.contains_key(&key) {
                    return Err(A::Error::custom(format!("found {key:?} twice; expected it once")));
                }
                map.insert(key, entries.next_value()?);
            }
            Ok(map)
        }
    }

    deserializer.deserialize_map(Entries(std::marker::PhantomData))
}
