//! Traffic from a user's file: messages, when each is sent, and after which others.

use std::collections::BTreeMap;
use std::fmt;

use config::{Document, Fault, Place, Quantity, read, refuse_unknown_keys, schema};
use desim::{Duration, Time};
use schemars::JsonSchema;
use serde::Deserialize;

use super::dependencies::Dependencies;

/// Longest message, bytes: a longer one must be a mistake.
pub(super) const MOST_BYTES: u64 = 1_000_000_000;
/// Latest time of a send, seconds: virtual time ends after 213 days.
pub(super) const LATEST: f64 = 86_400.0;

/// The most messages of a circle that are named.
const MOST_NAMED: usize = 20;

/// Messages to send.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// In the order of the file, which is the order of sending at equal times.
    pub messages: Vec<TraceMessage>,
}

/// A message to send.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceMessage {
    /// Its name in the file.
    pub name: String,
    /// When it is sent, unless `after` or a busy processor delays it.
    pub at: Time,
    /// The node that sends it.
    pub from: usize,
    /// The node that receives it.
    pub to: usize,
    /// Its length in bytes.
    pub bytes: u64,
    /// Indices of the messages that must have arrived before it is sent.
    pub after: Vec<usize>,
}

/// A message in the file.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object that describes a message")]
struct MessageFile {
    /// A unique name or number, without spaces, commas and quotes.
    id: Id,
    /// When it is sent, such as "0 us"; later if it has to wait for others, or if its node is busy.
    at: Quantity<config::Time>,
    /// The node that sends it: compute nodes from 0, then service nodes.
    from: u64,
    /// The node that receives it.
    to: u64,
    /// Its length in bytes.
    bytes: u64,
    /// The ids of messages that must have arrived before it is sent, at any node.
    #[serde(default)]
    after: Vec<Id>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a name or a whole number")]
enum Id {
    Number(u64),
    Name(String),
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Id::Number(number) => number.fmt(f),
            Id::Name(name) => name.fmt(f),
        }
    }
}

/// The JSON Schema of a trace.
pub fn trace_schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(Vec<MessageFile>).to_value();
    schema["title"] = "Virtwall trace".into();
    schema
}

impl Trace {
    /// Reads a trace's text, for a machine of `nodes` nodes; `file_name` is for messages only.
    ///
    /// # Errors
    /// [`Fault`], with file, message, field, value and what was expected.
    pub fn from_json(text: &str, file_name: &str, nodes: usize) -> Result<Trace, Fault> {
        let document = Document::parse(file_name, text.to_owned())?;
        refuse_unknown_keys(&schema::of::<Vec<MessageFile>>(), &document.value)
            .and_then(|()| check(&read::<Vec<MessageFile>>(&document.value)?, nodes))
            .map_err(|fault| document.locate(fault))
    }
}

fn check(items: &[MessageFile], nodes: usize) -> Result<Trace, Fault> {
    let mut numbers = BTreeMap::new();
    for (index, item) in items.iter().enumerate() {
        let (id, place) = (item.id.to_string(), Place::default().item(index).key("id"));
        check_name(&id).map_err(|message| Fault::at(place.clone(), message))?;
        if let Some(first) = numbers.insert(id.clone(), index) {
            let message = format!("found \"{id}\", the id of [{first}]; expected one of its own");
            return Err(Fault::at(place, message));
        }
    }
    let items = items.iter().enumerate();
    let items = items.map(|(index, item)| checked(index, item, nodes, &numbers));
    let trace = Trace { messages: items.collect::<Result<_, _>>()? };
    match trace.circle() {
        None => Ok(trace),
        Some(circle) => {
            let name = |&i: &usize| format!("\"{}\"", trace.messages[i].name);
            let names = circle.iter().take(MOST_NAMED).map(name).collect::<Vec<_>>();
            let rest = match circle.len().saturating_sub(MOST_NAMED) {
                0 => String::new(),
                rest => format!(" and so on, {rest} more"),
            };
            let names = names.join(" after ") + &rest;
            let message = format!("found a circle, {names}; expected messages that can be sent");
            Err(Fault::at(Place::default().item(circle[0]).key("after"), message))
        }
    }
}

/// Checks a message's name, which stands in lists of names.
pub(super) fn check_name(name: &str) -> Result<(), String> {
    if name.is_empty() || name.contains(|c: char| c.is_whitespace() || ",\"'".contains(c)) {
        return Err(format!("found \"{name}\"; expected a name without spaces, commas, quotes"));
    }
    Ok(())
}

/// Checks the fields of a message.
fn checked(
    index: usize,
    item: &MessageFile,
    nodes: usize,
    numbers: &BTreeMap<String, usize>,
) -> Result<TraceMessage, Fault> {
    let place = |field| Place::default().item(index).key(field);
    let refuse = |place: Place, found: &dyn fmt::Display, expected: String| {
        Err(Fault::at(place, format!("found {found}; expected {expected}")))
    };
    for (field, node) in [("from", item.from), ("to", item.to)] {
        if node >= nodes as u64 {
            return refuse(place(field), &node, format!("a node, 0 to {}", nodes - 1));
        }
    }
    if item.bytes > MOST_BYTES {
        return refuse(place("bytes"), &item.bytes, format!("at most {MOST_BYTES}"));
    }
    if item.at.value() > LATEST {
        return refuse(
            place("at"),
            &format!("{} s", item.at.value()),
            format!("at most {LATEST} s"),
        );
    }
    let mut after = Vec::new();
    for (i, id) in item.after.iter().enumerate() {
        match numbers.get(&id.to_string()) {
            Some(&number) => after.push(number),
            None => {
                let found = format!("\"{id}\"");
                return refuse(place("after").item(i), &found, "the id of a message".to_owned());
            }
        }
    }
    after.sort_unstable();
    after.dedup();
    let at = Time::ZERO + Duration::from_seconds_f64(item.at.value());
    let (from, to) = (item.from as usize, item.to as usize);
    Ok(TraceMessage { name: item.id.to_string(), at, from, to, bytes: item.bytes, after })
}

impl Trace {
    /// A circle of messages, each of which waits for the next one; the first one is repeated at the end.
    /// None if all messages can be sent.
    fn circle(&self) -> Option<Vec<usize>> {
        let waiting = self.waiting();
        let first = waiting.iter().position(|&waits| waits)?;
        // A message that cannot be sent waits for another one: following them leads into a circle.
        let next = |here: usize| self.messages[here].after.iter().copied().find(|&j| waiting[j]);
        let way = std::iter::successors(Some(first), |&here| next(here));
        let mut met = vec![false; self.messages.len()];
        let inside = way.into_iter().find(|&here| std::mem::replace(&mut met[here], true))?;
        let round = std::iter::successors(next(inside), |&here| next(here));
        let mut circle = vec![inside];
        circle.extend(round.take_while(|&here| here != inside));
        let least = (0..circle.len()).min_by_key(|&i| circle[i])?;
        circle.rotate_left(least);
        circle.push(circle[0]);
        Some(circle)
    }

    /// For each message, whether it can never be sent (Kahn's algorithm).
    fn waiting(&self) -> Vec<bool> {
        let mut dependencies = Dependencies::of(self.messages.iter().map(|message| &message.after));
        let all = 0..self.messages.len();
        let mut ready: Vec<usize> = all.clone().filter(|&i| !dependencies.waits(i)).collect();
        while let Some(sent) = ready.pop() {
            ready.extend(dependencies.end(sent));
        }
        all.map(|i| dependencies.waits(i)).collect()
    }
}
