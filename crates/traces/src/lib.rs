//! Recorded runs as files for trace viewers: Perfetto and Pajé.
//!
//! A [`Recording`] goes in, bytes come out. Times are virtual, in nanoseconds, rounded down.

mod activities; // numbers and names of activities
mod packets; // Perfetto's packets
mod paje; // the Pajé format
mod perfetto; // the Perfetto format
mod protobuf; // the encoding of protocol buffers
mod sample; // which messages are shown
mod track; // the events of one node in the order of time

use virtwall::Recording;

pub use sample::Sample;

/// The format of a trace file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// For ui.perfetto.dev and trace_processor: track events as protocol buffers, compressed.
    Perfetto,
    /// For pj_dump, ViTE and others: Pajé's self-describing text.
    Paje,
}

impl Format {
    /// The usual extension of such files, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Perfetto => "pftrace",
            Format::Paje => "trace",
        }
    }

    /// The bytes of a file that shows a run under a title.
    ///
    /// Each node has a track of its activities; in Perfetto waiting is blank. Each message is an arrow
    /// from where it is sent to where it is read, with its bytes. Counters show the length of each node's
    /// queue, and the unshot power and the power in transit in W.
    pub fn encode(self, recording: &Recording, title: &str, sample: Sample) -> Vec<u8> {
        match self {
            Format::Perfetto => perfetto::encode(recording, title, sample),
            Format::Paje => paje::encode(recording, title, sample),
        }
    }
}
