//! The packets of a Perfetto trace: compressed, each track's events in a sequence of their own, with times
//! as differences.

use std::io::Write as _;

use desim::Time;
use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::protobuf::Fields;

/// Numbers of the fields in Perfetto's `trace_packet.proto` and the files that it imports.
pub(crate) mod field {
    pub(crate) const TRACE_PACKET: u32 = 1;

    pub(crate) const PACKET_CLOCK_SNAPSHOT: u32 = 6;
    pub(crate) const PACKET_TIMESTAMP: u32 = 8;
    pub(crate) const PACKET_SEQUENCE_ID: u32 = 10;
    pub(crate) const PACKET_TRACK_EVENT: u32 = 11;
    pub(crate) const PACKET_INTERNED_DATA: u32 = 12;
    pub(crate) const PACKET_SEQUENCE_FLAGS: u32 = 13;
    pub(crate) const PACKET_COMPRESSED: u32 = 50;
    pub(crate) const PACKET_DEFAULTS: u32 = 59;
    pub(crate) const PACKET_TRACK_DESCRIPTOR: u32 = 60;

    pub(crate) const SNAPSHOT_CLOCKS: u32 = 1;
    pub(crate) const CLOCK_ID: u32 = 1;
    pub(crate) const CLOCK_TIMESTAMP: u32 = 2;
    pub(crate) const CLOCK_IS_INCREMENTAL: u32 = 3;

    pub(crate) const DEFAULTS_TRACK_EVENT: u32 = 11;
    pub(crate) const DEFAULTS_CLOCK_ID: u32 = 58;

    pub(crate) const TRACK_UUID: u32 = 1;
    pub(crate) const TRACK_NAME: u32 = 2;
    pub(crate) const TRACK_PARENT: u32 = 5;
    pub(crate) const TRACK_COUNTER: u32 = 8;
    pub(crate) const TRACK_CHILD_ORDERING: u32 = 11;
    pub(crate) const TRACK_RANK: u32 = 12;
    pub(crate) const COUNTER_UNIT_NAME: u32 = 6;

    pub(crate) const INTERNED_CATEGORIES: u32 = 1;
    pub(crate) const INTERNED_NAMES: u32 = 2;
    pub(crate) const INTERNED_ANNOTATIONS: u32 = 3;
    pub(crate) const ENTRY_ID: u32 = 1;
    pub(crate) const ENTRY_NAME: u32 = 2;

    pub(crate) const EVENT_CATEGORY: u32 = 3;
    pub(crate) const EVENT_ANNOTATION: u32 = 4;
    pub(crate) const EVENT_TYPE: u32 = 9;
    pub(crate) const EVENT_NAME: u32 = 10;
    pub(crate) const EVENT_TRACK: u32 = 11;
    pub(crate) const EVENT_COUNTER_VALUE: u32 = 30;
    pub(crate) const EVENT_COUNTER_DOUBLE: u32 = 44;
    pub(crate) const EVENT_FLOW: u32 = 47;
    pub(crate) const EVENT_LAST_FLOW: u32 = 48;
    pub(crate) const ANNOTATION_NAME: u32 = 1;
    pub(crate) const ANNOTATION_NUMBER: u32 = 3;
}

/// Bytes of packets that are compressed together.
const CHUNK: usize = 1 << 18;
/// The clock of the whole trace.
const BOOT_TIME: u64 = 6;
/// A sequence's own clock, whose times are differences from packet to packet.
const OWN_CLOCK: u64 = 64;
/// This packet begins a sequence.
const STATE_CLEARED: u64 = 1;

/// A trace that is being written.
#[derive(Default)]
pub(crate) struct Packets {
    chunk: Fields,
    written: Fields,
    sequences: u64,
}

/// Packets with a clock and a track of their own.
pub(crate) struct Sequence {
    id: u64,
    pub(crate) track: u64,
    last: u64,
}

impl Packets {
    /// Begins a sequence of events on a track.
    pub(crate) fn sequence(&mut self, track: u64, interned: impl FnOnce(&mut Fields)) -> Sequence {
        self.sequences += 1;
        let id = self.sequences;
        self.packet(|packet| {
            packet.number(field::PACKET_SEQUENCE_ID, id);
            packet.number(field::PACKET_SEQUENCE_FLAGS, STATE_CLEARED);
            packet.message(field::PACKET_CLOCK_SNAPSHOT, |snapshot| {
                for clock in [BOOT_TIME, OWN_CLOCK] {
                    snapshot.message(field::SNAPSHOT_CLOCKS, |fields| {
                        fields.number(field::CLOCK_ID, clock);
                        fields.number(field::CLOCK_TIMESTAMP, 0);
                        fields.number(field::CLOCK_IS_INCREMENTAL, u64::from(clock == OWN_CLOCK));
                    });
                }
            });
        });
        self.packet(|packet| {
            packet.number(field::PACKET_SEQUENCE_ID, id);
            packet.message(field::PACKET_DEFAULTS, |defaults| {
                defaults.number(field::DEFAULTS_CLOCK_ID, OWN_CLOCK);
                defaults.message(field::DEFAULTS_TRACK_EVENT, |event| {
                    event.number(field::EVENT_TRACK, track);
                });
            });
            packet.message(field::PACKET_INTERNED_DATA, interned);
        });
        Sequence { id, track, last: 0 }
    }

    /// Describes a track by its number, name, parent (0 for none), and the fields that `more` adds.
    pub(crate) fn track(
        &mut self,
        (number, parent): (u64, u64),
        name: &str,
        more: impl FnOnce(&mut Fields),
    ) {
        self.packet(|packet| {
            packet.message(field::PACKET_TRACK_DESCRIPTOR, |track| {
                track.number(field::TRACK_UUID, number);
                track.bytes(field::TRACK_NAME, name.as_bytes());
                if parent != 0 {
                    track.number(field::TRACK_PARENT, parent);
                }
                more(track);
            });
        });
    }

    /// Adds an event to a sequence; events come in the order of time.
    pub(crate) fn event(
        &mut self,
        sequence: &mut Sequence,
        at: Time,
        write: impl FnOnce(&mut Fields),
    ) {
        let now = at.0 / 1_000;
        let elapsed = now.saturating_sub(sequence.last);
        sequence.last = now;
        self.packet(|packet| {
            packet.number(field::PACKET_TIMESTAMP, elapsed);
            packet.number(field::PACKET_SEQUENCE_ID, sequence.id);
            packet.message(field::PACKET_TRACK_EVENT, write);
        });
    }

    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.compress();
        self.written.0
    }

    fn packet(&mut self, write: impl FnOnce(&mut Fields)) {
        self.chunk.message(field::TRACE_PACKET, write);
        if self.chunk.0.len() >= CHUNK {
            self.compress();
        }
    }

    fn compress(&mut self) {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        // Writing to memory does not fail. If it did, the packets would be stored uncompressed.
        let compressed = encoder.write_all(&self.chunk.0).and_then(|()| encoder.finish());
        match compressed {
            Ok(bytes) => self.written.message(field::TRACE_PACKET, |packet| {
                packet.bytes(field::PACKET_COMPRESSED, &bytes);
            }),
            Err(_) => self.written.0.extend(&self.chunk.0),
        }
        self.chunk.0.clear();
    }
}
