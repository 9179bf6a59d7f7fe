//! Recorded runs as files that trace viewers read: Perfetto, Pajé.
//!
//! Knows nothing of experiments or files: a [`Recording`] goes in, bytes come out. Times are virtual,
//! to the nanosecond below.

mod activities;
mod lane;
mod packets;
mod paje;
mod perfetto;
mod protobuf;
mod sample;

use virtwall::Recording;

pub use sample::Sample;

/// What a file is to be read by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// ui.perfetto.dev and trace_processor: track events as protocol buffers, deflated.
    Perfetto,
    /// pj_dump, ViTE and others: Pajé's self-defined text.
    Paje,
}

impl Format {
    /// The usual ending of such files, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Perfetto => "pftrace",
            Format::Paje => "trace",
        }
    }

    /// The bytes of a file that shows a run under a title.
    ///
    /// One lane a node: what it computes, its overheads and its paging; in Perfetto waiting is blank.
    /// An arrow a message, from where it is sent to where it is read, with its bytes. Counters: the
    /// length of each node's queue, the power unshot and in transit in W.
    pub fn encode(self, recording: &Recording, title: &str, sample: Sample) -> Vec<u8> {
        match self {
            Format::Perfetto => perfetto::encode(recording, title, sample),
            Format::Paje => paje::encode(recording, title, sample),
        }
    }
}
