//! A run as a Pajé trace: definitions of events, then events as lines of text in the order of time.
//!
//! de Oliveira Stein, Chassin de Kergommeaux, Mounié: Pajé trace file format, 2003.

use std::fmt::{self, Write as _};

use desim::Time;
use virtwall::{Activity, Recording};

use crate::activities::{activities, name, number};
use crate::sample::Sample;
use crate::track::{Event, Track};

/// The events that the trace uses, and their fields after the event's number.
const EVENTS: [(&str, &str); 11] = [
    ("PajeDefineContainerType", "Alias string, Type string, Name string"),
    ("PajeDefineStateType", "Alias string, Type string, Name string"),
    ("PajeDefineVariableType", "Alias string, Type string, Name string, Color color"),
    (
        "PajeDefineLinkType",
        "Alias string, Type string, StartContainerType string, EndContainerType string, Name string",
    ),
    ("PajeDefineEntityValue", "Alias string, Type string, Name string, Color color"),
    ("PajeSetState", "Time date, Type string, Container string, Value string"),
    ("PajeSetVariable", "Time date, Type string, Container string, Value double"),
    (
        "PajeStartLink",
        "Time date, Type string, Container string, Value string, StartContainer string, \
         Key string, Bytes int",
    ),
    (
        "PajeEndLink",
        "Time date, Type string, Container string, Value string, EndContainer string, Key string",
    ),
    ("PajeCreateContainer", "Time date, Alias string, Type string, Container string, Name string"),
    ("PajeDestroyContainer", "Time date, Type string, Name string"),
];
const SET_STATE: usize = 5;
const SET_VARIABLE: usize = 6;
const START_LINK: usize = 7;
const END_LINK: usize = 8;
const CREATE_CONTAINER: usize = 9;
const DESTROY_CONTAINER: usize = 10;

/// The state of a node that knows of the run's end.
const ENDED: &str = "z";

/// The types, by aliases: run R, node N; state S, queue Q, unshot power U, power in transit T, message
/// L. The run and then the nodes are numbered from 1, since 0 means no container.
const TYPES: &str = "0 R 0 Run
0 N R Node
1 S N Activity
2 Q N \"Queue length\" \"0.5 0.5 0.5\"
2 U R \"Unshot power, W\" \"0.9 0.7 0.1\"
2 T R \"Power in transit, W\" \"0.3 0.5 0.8\"
3 L R N N Message
";

/// The run's container.
const RUN: Alias = Alias(1);

/// The file's text.
///
/// An arrow is two lines with time, type, containers, value and key: some 55 bytes, with names of one or two
/// letters and times in nanoseconds.
pub(crate) fn encode(recording: &Recording, title: &str, sample: Sample) -> Vec<u8> {
    let mut text = definitions();
    let title = sample.caption(title).replace('"', "'");
    let _ = writeln!(text, "{CREATE_CONTAINER} 0 {RUN} R 0 \"{title}\"");
    let mut lines = Lines::default();
    for track in Track::all(recording, sample) {
        let (node, name) = (node(track.rank), track.name());
        let _ = writeln!(text, "{CREATE_CONTAINER} 0 {node} N {RUN} \"{name}\"");
        states(&mut lines, &node, &track);
    }
    powers(&mut lines, recording);
    messages(&mut lines, recording, sample);
    let end = lines.write(&mut text);
    for rank in 0..recording.nodes.len() {
        let _ = writeln!(text, "{DESTROY_CONTAINER} {} N {}", Seconds(end), node(rank));
    }
    let _ = writeln!(text, "{DESTROY_CONTAINER} {} R {RUN}", Seconds(end));
    text.into_bytes()
}

fn definitions() -> String {
    let mut text = String::new();
    for (number, (name, fields)) in EVENTS.iter().enumerate() {
        let _ = writeln!(text, "%EventDef {name} {number}");
        fields.split(", ").for_each(|field| _ = writeln!(text, "% {field}"));
        text += "%EndEventDef\n";
    }
    text += TYPES;
    for activity in activities() {
        let (alias, name, colour) = (alias(activity), name(activity), colour(activity));
        let _ = writeln!(text, "4 {alias} S \"{name}\" \"{colour}\"");
        if let Activity::Send(kind) = activity {
            let _ = writeln!(text, "4 {alias} L \"{}\" \"{colour}\"", kind.name());
        }
    }
    let _ = writeln!(text, "4 {ENDED} S ended \"1 1 1\"");
    text
}

/// The states of a node, and the length of its queue. Successive spans of one activity are one state.
fn states(lines: &mut Lines, container: &Alias, track: &Track) {
    let mut last = None;
    for (time, event) in track.events(true) {
        if let Event::Begin(activity, _) = event
            && last.replace(activity) != Some(activity)
        {
            let alias = alias(activity);
            lines.add(time, 0, format_args!("{SET_STATE} {} S {container} {alias}", Seconds(time)));
        }
    }
    let end = track.node.end();
    lines.add(end, 0, format_args!("{SET_STATE} {} S {container} {ENDED}", Seconds(end)));
    // Of several lengths at one time the last one lasts.
    let lengths = track.node.queue.chunk_by(|a, b| a.0 == b.0).filter_map(|at_once| at_once.last());
    for (i, &(time, length)) in lengths.enumerate() {
        if track.sample.holds(i) {
            let time_s = Seconds(time);
            lines.add(time, 1, format_args!("{SET_VARIABLE} {time_s} Q {container} {length}"));
        }
    }
}

/// To four digits, which is more than a chart shows.
fn powers(lines: &mut Lines, recording: &Recording) {
    let mut last = [None; 2];
    for energy in &recording.energy {
        let values = [energy.unshot, energy.in_transit].map(four_digits);
        for ((last, value), variable) in last.iter_mut().zip(values).zip(["U", "T"]) {
            if last.replace(value) != Some(value) {
                let time = Seconds(energy.at);
                let line = format_args!("{SET_VARIABLE} {time} {variable} {RUN} {value}");
                lines.add(energy.at, 1, line);
            }
        }
    }
}

fn four_digits(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Arrows; one that was never read ends where it has arrived, and one that has not is left out.
fn messages(lines: &mut Lines, recording: &Recording, sample: Sample) {
    for (number, message) in recording.messages.iter().enumerate() {
        let Some(end) = message.read.or(message.arrived).filter(|_| sample.holds(number)) else {
            continue;
        };
        let kind = alias(Activity::Send(message.kind));
        let (from, to) = (node(message.from as usize), node(message.to as usize));
        let (sent, key, bytes) = (Seconds(message.sent), Alias(number), message.bytes);
        let start = format_args!("{START_LINK} {sent} L {RUN} {kind} {from} {key} {bytes}");
        lines.add(message.sent, 2, start);
        let end_s = Seconds(end);
        lines.add(end, 3, format_args!("{END_LINK} {end_s} L {RUN} {kind} {to} {key}"));
    }
}

/// Lines that are to be sorted by time.
#[derive(Default)]
struct Lines {
    text: String,
    /// Time, order at one time, and where the line begins and ends in the text.
    index: Vec<(Time, u8, usize, usize)>,
}

impl Lines {
    fn add(&mut self, time: Time, order: u8, line: fmt::Arguments) {
        let begin = self.text.len();
        let _ = writeln!(self.text, "{line}");
        self.index.push((time, order, begin, self.text.len()));
    }

    /// Writes the lines in order; returns the time of the last one.
    fn write(mut self, to: &mut String) -> Time {
        self.index.sort_unstable();
        for &(_, _, begin, end) in &self.index {
            *to += &self.text[begin..end];
        }
        self.index.last().map_or(Time::ZERO, |&(time, ..)| time)
    }
}

/// The alias of an activity, and of the messages that it sends: a letter.
fn alias(activity: Activity) -> char {
    (b'a' + number(activity) as u8) as char
}

fn colour(activity: Activity) -> &'static str {
    match activity {
        Activity::Selection => "0.95 0.85 0.40",
        Activity::LocalShot => "0.90 0.45 0.10",
        Activity::ReceivedShot => "0.20 0.55 0.80",
        Activity::Send(_) => "0.60 0.35 0.65",
        Activity::Receive => "0.80 0.60 0.85",
        Activity::Pack | Activity::Copy | Activity::Forward => "0.55 0.45 0.35",
        Activity::WaitForRoom | Activity::WaitForDisplay => "0.80 0.20 0.20",
        Activity::Paging => "0.40 0.10 0.10",
        Activity::Wait => "0.90 0.90 0.90",
    }
}

/// The container of a node.
fn node(rank: usize) -> Alias {
    Alias(rank + 2)
}

/// A number as a short name in base 62, the lowest digit first.
#[derive(Clone, Copy)]
struct Alias(usize);

impl fmt::Display for Alias {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const DIGITS: &[u8; 62] = b"0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
        let mut rest = self.0;
        loop {
            f.write_char(DIGITS[rest % DIGITS.len()].into())?;
            rest /= DIGITS.len();
            if rest == 0 {
                return Ok(());
            }
        }
    }
}

/// A time in seconds, rounded down to nanoseconds, without trailing zeros.
struct Seconds(Time);

impl fmt::Display for Seconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ns = self.0.0 / 1_000;
        let (whole, mut part, mut digits) = (ns / 1_000_000_000, ns % 1_000_000_000, 9);
        if part == 0 {
            return write!(f, "{whole}");
        }
        while part % 10 == 0 {
            (part, digits) = (part / 10, digits - 1);
        }
        write!(f, "{whole}.{part:0digits$}")
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn aliases_are_unique() {
        let names: BTreeSet<String> = (0..10_000).map(|n| Alias(n).to_string()).collect();
        assert_eq!(names.len(), 10_000);
        assert!(names.iter().all(|name| name.len() <= 3));
    }

    #[test]
    fn seconds_are_exact_and_short() {
        for (ps, text) in [
            (0, "0"),
            (999, "0"),
            (1_000, "0.000000001"),
            (1_500_000_000_000, "1.5"),
            (6_253_559_567_123_999, "6253.559567123"),
            (20_000_000_000_000, "20"),
        ] {
            assert_eq!(Seconds(Time(ps)).to_string(), text);
        }
    }
}
