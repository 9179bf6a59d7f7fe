//! Reads a Perfetto trace as trace_processor does, as far as our traces need. The messages are declared from
//! Perfetto's definitions, independently of the code that writes them.

#![allow(dead_code, reason = "each test file uses some of these")]

use std::collections::BTreeMap;
use std::io::Read as _;

use flate2::read::ZlibDecoder;
use prost::Message;

#[derive(Message)]
struct Trace {
    #[prost(message, repeated, tag = "1")]
    packet: Vec<TracePacket>,
}

#[derive(Message)]
struct TracePacket {
    #[prost(message, optional, tag = "6")]
    clock_snapshot: Option<ClockSnapshot>,
    #[prost(uint64, optional, tag = "8")]
    timestamp: Option<u64>,
    #[prost(uint32, tag = "10")]
    trusted_packet_sequence_id: u32,
    #[prost(message, optional, tag = "11")]
    track_event: Option<TrackEvent>,
    #[prost(message, optional, tag = "12")]
    interned_data: Option<InternedData>,
    #[prost(uint32, tag = "13")]
    sequence_flags: u32,
    #[prost(bytes, optional, tag = "50")]
    compressed_packets: Option<Vec<u8>>,
    #[prost(message, optional, tag = "59")]
    trace_packet_defaults: Option<TracePacketDefaults>,
    #[prost(message, optional, tag = "60")]
    track_descriptor: Option<TrackDescriptor>,
}

#[derive(Message)]
struct ClockSnapshot {
    #[prost(message, repeated, tag = "1")]
    clocks: Vec<Clock>,
}

#[derive(Message)]
struct Clock {
    #[prost(uint32, tag = "1")]
    clock_id: u32,
    #[prost(uint64, tag = "2")]
    timestamp: u64,
    #[prost(bool, tag = "3")]
    is_incremental: bool,
}

#[derive(Message)]
struct TracePacketDefaults {
    #[prost(message, optional, tag = "11")]
    track_event_defaults: Option<TrackEventDefaults>,
    #[prost(uint32, tag = "58")]
    timestamp_clock_id: u32,
}

#[derive(Message)]
struct TrackEventDefaults {
    #[prost(uint64, tag = "11")]
    track_uuid: u64,
}

#[derive(Message)]
struct TrackDescriptor {
    #[prost(uint64, tag = "1")]
    uuid: u64,
    #[prost(string, tag = "2")]
    name: String,
    #[prost(uint64, optional, tag = "5")]
    parent_uuid: Option<u64>,
    #[prost(message, optional, tag = "8")]
    counter: Option<CounterDescriptor>,
}

#[derive(Message)]
struct CounterDescriptor {
    #[prost(string, tag = "6")]
    unit_name: String,
}

#[derive(Message)]
struct InternedData {
    #[prost(message, repeated, tag = "1")]
    event_categories: Vec<Entry>,
    #[prost(message, repeated, tag = "2")]
    event_names: Vec<Entry>,
    #[prost(message, repeated, tag = "3")]
    debug_annotation_names: Vec<Entry>,
}

#[derive(Message)]
struct Entry {
    #[prost(uint64, tag = "1")]
    iid: u64,
    #[prost(string, tag = "2")]
    name: String,
}

#[derive(Message)]
struct TrackEvent {
    #[prost(uint64, repeated, packed = "false", tag = "3")]
    category_iids: Vec<u64>,
    #[prost(message, repeated, tag = "4")]
    debug_annotations: Vec<DebugAnnotation>,
    #[prost(int32, tag = "9")]
    kind: i32,
    #[prost(uint64, tag = "10")]
    name_iid: u64,
    #[prost(int64, optional, tag = "30")]
    counter_value: Option<i64>,
    #[prost(double, optional, tag = "44")]
    double_counter_value: Option<f64>,
    #[prost(fixed64, repeated, packed = "false", tag = "47")]
    flow_ids: Vec<u64>,
    #[prost(fixed64, repeated, packed = "false", tag = "48")]
    terminating_flow_ids: Vec<u64>,
}

#[derive(Message)]
struct DebugAnnotation {
    #[prost(uint64, tag = "1")]
    name_iid: u64,
    #[prost(uint64, tag = "3")]
    uint_value: u64,
}

/// What a trace shows; times in ns.
#[derive(Default)]
pub struct Read {
    /// Names of all tracks, those of queues after their nodes' and a slash.
    pub tracks: Vec<String>,
    pub slices: Vec<Slice>,
    pub departures: Vec<Departure>,
    pub arrivals: Vec<Arrival>,
    pub counters: Vec<Counter>,
}

pub struct Slice {
    pub track: String,
    pub name: String,
    pub category: String,
    pub from: u64,
    pub to: u64,
}

pub struct Departure {
    pub track: String,
    pub name: String,
    pub at: u64,
    pub bytes: u64,
    pub flow: u64,
}

pub struct Arrival {
    pub track: String,
    pub at: u64,
    pub flow: u64,
}

pub struct Counter {
    pub track: String,
    pub value: f64,
}

/// The state of a sequence of packets.
#[derive(Default)]
struct State {
    now: u64,
    track: u64,
    names: BTreeMap<u64, String>,
    categories: BTreeMap<u64, String>,
    annotations: BTreeMap<u64, String>,
    open: Vec<Slice>,
}

/// Reads a trace and makes sure that it is sound.
pub fn read(bytes: &[u8]) -> Read {
    let mut reader = Reader::default();
    reader.trace(bytes);
    assert!(reader.states.values().all(|state| state.open.is_empty()), "a slice does not end");
    reader.read
}

#[derive(Default)]
struct Reader {
    read: Read,
    tracks: BTreeMap<u64, String>,
    states: BTreeMap<u32, State>,
}

impl Reader {
    fn trace(&mut self, bytes: &[u8]) {
        for packet in Trace::decode(bytes).unwrap().packet {
            match &packet.compressed_packets {
                Some(deflated) => {
                    let mut packets = Vec::new();
                    ZlibDecoder::new(&deflated[..]).read_to_end(&mut packets).unwrap();
                    self.trace(&packets);
                }
                None => self.packet(&packet),
            }
        }
    }

    fn packet(&mut self, packet: &TracePacket) {
        if let Some(track) = &packet.track_descriptor {
            let parent = track.parent_uuid.map(|parent| self.tracks[&parent].clone());
            let name = match parent.filter(|_| track.name == "queue") {
                Some(parent) => format!("{parent}/{}", track.name),
                None => track.name.clone(),
            };
            self.read.tracks.push(name.clone());
            assert_eq!(self.tracks.insert(track.uuid, name), None, "a track described twice");
            return;
        }
        let state = self.states.entry(packet.trusted_packet_sequence_id).or_default();
        if packet.sequence_flags & 1 != 0 {
            *state = State::default();
        }
        if let Some(snapshot) = &packet.clock_snapshot {
            let clocks =
                snapshot.clocks.iter().map(|c| (c.clock_id, c.timestamp, c.is_incremental));
            assert!(clocks.eq([(6, 0, false), (64, 0, true)]));
        }
        if let Some(defaults) = &packet.trace_packet_defaults {
            assert_eq!(defaults.timestamp_clock_id, 64);
            state.track = defaults.track_event_defaults.as_ref().unwrap().track_uuid;
        }
        if let Some(data) = &packet.interned_data {
            let map = |entries: &[Entry]| -> BTreeMap<u64, String> {
                entries.iter().map(|entry| (entry.iid, entry.name.clone())).collect()
            };
            state.names = map(&data.event_names);
            state.categories = map(&data.event_categories);
            state.annotations = map(&data.debug_annotation_names);
        }
        if let Some(event) = &packet.track_event {
            state.now += packet.timestamp.unwrap();
            state.event(event, &self.tracks[&state.track], &mut self.read);
        }
    }
}

impl State {
    fn event(&mut self, event: &TrackEvent, track: &str, read: &mut Read) {
        let track = || track.to_owned();
        let at = self.now;
        match event.kind {
            1 => {
                assert!(self.open.is_empty(), "a node does one thing at a time");
                let category = self.categories[&event.category_iids[0]].clone();
                let name = self.names[&event.name_iid].clone();
                let slice = Slice { track: track(), name, category, from: at, to: at };
                self.open.push(slice);
            }
            2 => {
                let slice = self.open.pop().unwrap();
                read.slices.push(Slice { to: at, ..slice });
            }
            3 => {}
            4 => {
                let whole = event.counter_value.map(|value| value as f64);
                let value = whole.or(event.double_counter_value).unwrap();
                read.counters.push(Counter { track: track(), value });
            }
            other => panic!("an event of type {other}"),
        }
        for &flow in &event.terminating_flow_ids {
            read.arrivals.push(Arrival { track: track(), at, flow });
        }
        for &flow in &event.flow_ids {
            let bytes = |a: &&DebugAnnotation| self.annotations[&a.name_iid] == "bytes";
            let bytes = event.debug_annotations.iter().find(bytes).unwrap().uint_value;
            let name = self.names[&event.name_iid].clone();
            read.departures.push(Departure { track: track(), name, at, bytes, flow });
        }
    }
}
