//! The automatic choice of a network model: the cheapest one that is accurate enough.
//!
//! A program runs on the cheapest model first, and its messages are recorded. A pilot sends the same
//! messages at the same times over the next model. There each may arrive later and cost its sender or
//! its receiver more. Such delays add up along chains of messages, from a node to the next that
//! receives from it. If the longest chain is short compared with the program's time, the cheaper model
//! is accurate enough. Otherwise the program runs on the next model too: if its time hardly differs,
//! the cheaper model is accurate enough, else the next model takes its place.

use desim::{Duration, Time};

use super::formula::ContentionFree;
use super::ideal::Ideal;
use super::links::LinkParameters;
use super::message::Message;
use super::model::{NetworkModel, NetworkParameters};
use super::network::Network;
use super::record::{Record, RecordedMessage, Recorder};
use super::topology::Topology;

/// Most flits times channels that a pilot sends: some seconds of the host's time.
const LONGEST_PILOT: u64 = 50_000_000;
/// Most flits times channels of a program that is run flit by flit: some minutes.
const LONGEST_RUN: u64 = 2_000_000_000;

/// The chosen model, and the program's run on it.
#[derive(Clone, Debug)]
pub struct AutoResult<A> {
    /// The model.
    pub model: NetworkModel,
    /// What the program returned.
    pub answer: A,
    /// The program's time.
    pub time: Time,
    /// Its messages.
    pub record: Record,
    /// Why this model was chosen.
    pub why: String,
}

/// Runs a program, by `run`, on the cheapest network model whose time differs by at most the share
/// `tolerance` from that on the next model.
///
/// # Errors
/// Those of `run`.
pub fn choose<A, E>(
    parameters: &NetworkParameters,
    topology: &Topology,
    tolerance: f64,
    mut run: impl FnMut(Box<dyn Network>) -> Result<(Time, A), E>,
) -> Result<AutoResult<A>, E> {
    let mut on = |model, network| {
        let (recorder, record) = Recorder::new(network);
        let (time, answer) = run(Box::new(recorder))?;
        Ok(AutoResult { model, answer, time, record: record.take(), why: String::new() })
    };
    let links = parameters.links.as_ref();
    let mut chosen = on(NetworkModel::Ideal, Box::new(ContentionFree::new(Ideal)))?;
    let percent = |share: f64| format!("{:.3} %", share * 100.0);
    for next in NetworkModel::ALL.into_iter().skip(1) {
        let build = || parameters.build(next, topology);
        let (Some(pilot_network), Some(network)) = (build(), build()) else {
            chosen.why = format!("the machine's file says too little for {next}");
            return Ok(chosen);
        };
        let (delay, sample) = pilot(&chosen.record, pilot_network, (links, topology), next);
        let share = delay.as_seconds_f64() / chosen.time.as_seconds_f64().max(1e-12);
        let load = links.map_or(String::new(), |links| {
            let busiest = chosen.record.busiest_link(topology, links, chosen.time);
            format!("the busiest link works {} of the time; ", percent(busiest))
        });
        let messages = chosen.record.messages.len();
        let tried = format!("{load}a pilot of {sample} of {messages} messages on {next} adds");
        if share <= tolerance {
            chosen.why = format!("{tried} at most {}", percent(share));
            return Ok(chosen);
        }
        let tried = format!("{tried} up to {}", percent(share));
        if next == NetworkModel::Flit
            && work(&chosen.record.messages, links, topology) > LONGEST_RUN
        {
            chosen.why = format!("{tried}; all on flit would take too long");
            return Ok(chosen);
        }
        let finer = on(next, network)?;
        let (a, b) = (chosen.time.as_seconds_f64(), finer.time.as_seconds_f64());
        let change = (a - b).abs() / b.max(1e-12);
        if change <= tolerance {
            chosen.why = format!("{tried}, a run on it changes {}", percent(change));
            return Ok(chosen);
        }
        let cheaper = chosen.model;
        chosen = finer;
        chosen.why =
            format!("{cheaper} differs by {}, and there is no finer model", percent(change));
    }
    Ok(chosen)
}

/// How much later a program might end over `network` than it did, and how many of its messages that
/// is estimated from.
fn pilot(
    record: &Record,
    mut network: Box<dyn Network>,
    (links, topology): (Option<&LinkParameters>, &Topology),
    model: NetworkModel,
) -> (Duration, usize) {
    let messages = match model {
        NetworkModel::Flit => busiest_stretch(&record.messages, links, topology),
        _ => &record.messages[..],
    };
    if messages.is_empty() {
        return (Duration::ZERO, 0);
    }
    let delays = delays(record, messages, network.as_mut());
    let longest = longest_chain(messages, &delays);
    let all = record.messages.len() as f64 / messages.len() as f64;
    (Duration::from_seconds_f64(longest.as_seconds_f64() * all), messages.len())
}

/// What a message costs more than it did.
#[derive(Clone, Copy, Default)]
struct Delay {
    sender: Duration,
    network: Duration,
    receiver: Duration,
}

/// Sends messages at their recorded times over another network. A deadlock delays the rest forever.
fn delays(record: &Record, messages: &[RecordedMessage], network: &mut dyn Network) -> Vec<Delay> {
    let receiver = network.receive_overhead() - record.receive_overhead;
    let mut delays =
        vec![Delay { network: Duration::MAX, receiver, ..Delay::default() }; messages.len()];
    let mut arrived = Vec::new();
    let mut waiting = messages.iter().enumerate().peekable();
    loop {
        let due = waiting.peek().map(|(_, message)| message.at);
        let Some(now) = [due, network.next_event()].into_iter().flatten().min() else { break };
        if network.advance(now, &mut arrived).is_err() {
            break;
        }
        while let Some((index, message)) = waiting.next_if(|(_, message)| message.at <= now) {
            let RecordedMessage { from, to, bytes, .. } = *message;
            let free = network.send(now, Message { id: index as u64, from, to, bytes });
            delays[index].sender = (free - now) - message.sender_busy;
        }
        for arrival in arrived.drain(..) {
            let index = arrival.message.id as usize;
            delays[index].network = arrival.at - messages[index].arrived.unwrap_or(arrival.at);
        }
    }
    delays
}

/// The longest sum of delays from message to message, where a node passes on what has delayed it.
fn longest_chain(messages: &[RecordedMessage], delays: &[Delay]) -> Duration {
    let mut events: Vec<(Time, usize, bool)> = Vec::new();
    for (index, message) in messages.iter().enumerate() {
        events.push((message.at, index, false));
        events.extend(message.arrived.map(|at| (at, index, true)));
    }
    // At one time a node reads before it sends, so that a delay is passed on at once.
    events.sort_unstable_by_key(|&(at, index, arrives)| (at, !arrives, index));
    let places = messages.iter().map(|message| message.from.index().max(message.to.index())).max();
    let mut nodes = vec![Duration::ZERO; places.map_or(0, |most| most + 1)];
    let mut chains = vec![Duration::ZERO; messages.len()];
    for (_, index, arrives) in events {
        let (message, delay) = (&messages[index], &delays[index]);
        if arrives {
            let node = &mut nodes[message.to.index()];
            *node = (*node).max(chains[index]) + delay.receiver;
        } else {
            let node = &mut nodes[message.from.index()];
            chains[index] = *node + delay.network;
            *node += delay.sender;
        }
    }
    nodes.into_iter().chain(chains).max().unwrap_or_default()
}

/// Consecutive messages, as many as a pilot may send, in the shortest time.
fn busiest_stretch<'a>(
    messages: &'a [RecordedMessage],
    links: Option<&LinkParameters>,
    topology: &Topology,
) -> &'a [RecordedMessage] {
    let all = work(messages, links, topology).max(1);
    let share = LONGEST_PILOT as f64 / all as f64;
    let count = ((messages.len() as f64 * share) as usize).clamp(1, messages.len().max(1));
    let stretches = messages.windows(count);
    stretches.min_by_key(|s| s[count - 1].at - s[0].at).unwrap_or(messages)
}

/// Flits times channels.
fn work(messages: &[RecordedMessage], links: Option<&LinkParameters>, topology: &Topology) -> u64 {
    let flits = |links: &LinkParameters, message: &RecordedMessage| {
        let channels = topology.hops(message.from, message.to) + 2;
        links.flits(message.bytes) * u64::from(channels)
    };
    links.map_or(0, |links| messages.iter().map(|message| flits(links, message)).sum())
}
