//! The cheapest rung whose answer is near enough to that of the next one.
//!
//! A program runs on the lowest rung first, and what it sends is written down. A pilot sends the same
//! messages at the same times over the next rung. Each may arrive later there and cost its sender or
//! its receiver more; such delays add up along chains of messages, from a node to the next that hears
//! of it. If the longest chain is short beside the program's time, the rung will do. Otherwise the
//! program runs on the next rung too: if its time hardly differs, the lower rung will do, else the next
//! one takes its place.

use desim::{Duration, Time};

use crate::machine::Machine;
use crate::network::{LinkParameters, Message, Network, Rung};
use crate::record::{Letter, Record, Recorder};

/// Flits times channels that a pilot sends at most: some seconds of the host's time.
const LONGEST_PILOT: u64 = 50_000_000;
/// Flits times channels of a program that is still run flit by flit: some minutes.
const LONGEST_RUN: u64 = 2_000_000_000;

/// The rung chosen, and what the program found on it.
#[derive(Clone, Debug)]
pub struct Choice<A> {
    /// The rung.
    pub rung: Rung,
    /// What the program found.
    pub answer: A,
    /// How long it took.
    pub time: Time,
    /// What it sent.
    pub record: Record,
    /// Why this rung.
    pub why: String,
}

/// Runs a program, by `run`, on the cheapest rung of a machine's network whose time differs by no more
/// than the part `tolerance` from that on the next rung.
///
/// # Errors
/// Those of `run`.
pub fn choose<A, E>(
    machine: &Machine,
    tolerance: f64,
    mut run: impl FnMut(Box<dyn Network>) -> Result<(Time, A), E>,
) -> Result<Choice<A>, E> {
    let mut on = |rung, network| {
        let (recorder, record) = Recorder::new(network);
        let (time, answer) = run(Box::new(recorder))?;
        Ok(Choice { rung, answer, time, record: record.take(), why: String::new() })
    };
    let mut chosen = on(Rung::Ideal, machine.network_on(Rung::Ideal).unwrap_or(machine.network()))?;
    let percent = |part: f64| format!("{:.3} %", part * 100.0);
    for next in Rung::ALL.into_iter().skip(1) {
        let Ok(network) = machine.network_on(next) else {
            chosen.why = format!("the machine's file says too little for {next}");
            return Ok(chosen);
        };
        let links = machine.parameters.links.as_ref();
        let (delay, sample) = pilot(&chosen.record, network, machine, next);
        let part = delay.as_seconds_f64() / chosen.time.as_seconds_f64().max(1e-12);
        let load = links.map_or(String::new(), |links| {
            let busiest = chosen.record.busiest_link(machine.topology(), links, chosen.time);
            format!("the busiest link works {} of the time; ", percent(busiest))
        });
        let letters = chosen.record.letters.len();
        let tried = format!("{load}a pilot of {sample} of {letters} messages on {next} adds");
        if part <= tolerance {
            chosen.why = format!("{tried} at most {}", percent(part));
            return Ok(chosen);
        }
        let tried = format!("{tried} up to {}", percent(part));
        if next == Rung::Flit && work(&chosen.record.letters, machine) > LONGEST_RUN {
            chosen.why = format!("{tried}; all on flit would take too long");
            return Ok(chosen);
        }
        let network = machine.network_on(next).unwrap_or(machine.network());
        let above = on(next, network)?;
        let (a, b) = (chosen.time.as_seconds_f64(), above.time.as_seconds_f64());
        let change = (a - b).abs() / b.max(1e-12);
        if change <= tolerance {
            chosen.why = format!("{tried}, a run on it changes {}", percent(change));
            return Ok(chosen);
        }
        let below = chosen.rung;
        chosen = above;
        chosen.why = format!("{below} differs by {}, and there is no finer rung", percent(change));
    }
    Ok(chosen)
}

/// How much later a program might end over `network` than it did, and by how many of its messages
/// that was estimated.
fn pilot(
    record: &Record,
    mut network: Box<dyn Network>,
    machine: &Machine,
    rung: Rung,
) -> (Duration, usize) {
    let letters = match rung {
        Rung::Flit => busiest_stretch(&record.letters, machine),
        _ => &record.letters[..],
    };
    if letters.is_empty() {
        return (Duration::ZERO, 0);
    }
    let later = later(record, letters, network.as_mut());
    let longest = longest_chain(letters, &later);
    let all = record.letters.len() as f64 / letters.len() as f64;
    (Duration::from_seconds_f64(longest.as_seconds_f64() * all), letters.len())
}

/// What a letter costs more than it did.
#[derive(Clone, Copy, Default)]
struct Later {
    sender: Duration,
    network: Duration,
    receiver: Duration,
}

/// Sends letters as they were sent, over another network; a deadlock delays for ever.
fn later(record: &Record, letters: &[Letter], network: &mut dyn Network) -> Vec<Later> {
    let receiver = network.receive_overhead() - record.receive_overhead;
    let mut found =
        vec![Later { network: Duration::MAX, receiver, ..Later::default() }; letters.len()];
    let mut arrived = Vec::new();
    let mut waiting = letters.iter().enumerate().peekable();
    loop {
        let due = waiting.peek().map(|(_, letter)| letter.at);
        let Some(now) = [due, network.next_event()].into_iter().flatten().min() else { break };
        if network.advance(now, &mut arrived).is_err() {
            break;
        }
        while let Some((index, letter)) = waiting.next_if(|(_, letter)| letter.at <= now) {
            let Letter { from, to, bytes, .. } = *letter;
            let free = network.send(now, Message { id: index as u64, from, to, bytes });
            found[index].sender = (free - now) - letter.sender_busy;
        }
        for arrival in arrived.drain(..) {
            let index = arrival.message.id as usize;
            found[index].network = arrival.at - letters[index].arrived.unwrap_or(arrival.at);
        }
    }
    found
}

/// The longest sum of delays from message to message, where a node passes on what has delayed it.
fn longest_chain(letters: &[Letter], later: &[Later]) -> Duration {
    let mut events: Vec<(Time, usize, bool)> = Vec::new();
    for (index, letter) in letters.iter().enumerate() {
        events.push((letter.at, index, false));
        events.extend(letter.arrived.map(|at| (at, index, true)));
    }
    // At one time a node reads before it sends, so that a delay is passed on at once.
    events.sort_unstable_by_key(|&(at, index, arrives)| (at, !arrives, index));
    let places = letters.iter().map(|letter| letter.from.index().max(letter.to.index())).max();
    let mut nodes = vec![Duration::ZERO; places.map_or(0, |most| most + 1)];
    let mut chains = vec![Duration::ZERO; letters.len()];
    for (_, index, arrives) in events {
        let (letter, later) = (&letters[index], &later[index]);
        if arrives {
            let node = &mut nodes[letter.to.index()];
            *node = (*node).max(chains[index]) + later.receiver;
        } else {
            let node = &mut nodes[letter.from.index()];
            chains[index] = *node + later.network;
            *node += later.sender;
        }
    }
    nodes.into_iter().chain(chains).max().unwrap_or_default()
}

/// Consecutive letters, as many as a pilot may send, in the shortest time.
fn busiest_stretch<'a>(letters: &'a [Letter], machine: &Machine) -> &'a [Letter] {
    let all = work(letters, machine).max(1);
    let share = LONGEST_PILOT as f64 / all as f64;
    let count = ((letters.len() as f64 * share) as usize).clamp(1, letters.len().max(1));
    let stretches = letters.windows(count);
    stretches.min_by_key(|s| s[count - 1].at - s[0].at).unwrap_or(letters)
}

/// Flits times channels.
fn work(letters: &[Letter], machine: &Machine) -> u64 {
    let flits = |links: &LinkParameters, letter: &Letter| {
        let channels = machine.topology().hops(letter.from, letter.to) + 2;
        letter.bytes.div_ceil(links.flit_bytes).max(1) * u64::from(channels)
    };
    let links = machine.parameters.links.as_ref();
    links.map_or(0, |links| letters.iter().map(|letter| flits(links, letter)).sum())
}
