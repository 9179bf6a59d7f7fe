//! The model `wormhole`: wormhole routing, message by message.
//!
//! A message is a worm of flits. Its head goes from channel to channel along the route. Where another
//! message holds a channel it waits, first come, first served, and keeps the channels that it has. When
//! the head has arrived, the rest follows at the rate of the links, and every channel is free when the
//! tail has passed it. Alone on the network, a message takes the time of LogGP:
//!
//! ```text
//! sender    |-- o --|
//! port              |-- n G - n Gl --|-- n Gl --|-- g --|
//! link i                      h i -->|-- n Gl --|
//! receiver                    h H -->|-- n Gl --|-- L --|-- o --|
//! ```
//!
//! Gl is the time of a byte on a link, h the time of a hop, H the number of hops. A message that fits
//! into fewer buffers than it has channels frees the channels behind its tail while its head waits.
//!
//! Only those virtual channels are modelled that keep a torus free of deadlock: its links then have two
//! lanes, which two messages can hold at the same time. Their bytes cross the link one after the other.

use std::collections::VecDeque;

use desim::{Duration, EventQueue, Time};

use super::channel::{Channel, Channels};
use super::deadlock::Deadlock;
use super::holders::PastHolders;
use super::links::LinkParameters;
use super::loggp::LogGpParameters;
use super::message::Message;
use super::network::{Arrival, ChannelUse, Network, Stall};
use super::topology::{Shape, Topology};

/// A wormhole network.
pub struct Wormhole {
    software: LogGpParameters,
    links: LinkParameters,
    topology: Topology,
    channels: Channels,
    /// By number of the channel, then the second lanes, if there are any.
    lanes: Vec<Lane>,
    second_lanes: bool,
    /// By number of the channel.
    uses: Vec<Use>,
    worms: Vec<Worm>,
    idle_worms: Vec<u32>,
    events: EventQueue<Event>,
    waiting: usize,
}

/// A channel, or one of its virtual channels.
#[derive(Default)]
struct Lane {
    /// The message that holds it, until the time of its leaving is known.
    holder: Option<u32>,
    /// When the last holder leaves.
    free: Time,
    past_holders: PastHolders,
    queue: VecDeque<u32>,
}

/// The use of a channel.
#[derive(Clone, Copy, Default)]
struct Use {
    messages: u64,
    held: Duration,
    carrying: Duration,
    /// When the bytes assigned to it will have passed.
    passed: Time,
}

/// A message in the network.
struct Worm {
    message: Message,
    /// Its lanes, each with the time at which it got it.
    path: Vec<(u32, Time)>,
    /// Number of lanes that its head has entered.
    taken: usize,
    /// Number of lanes that its tail has left.
    left: usize,
    /// Start of its head's wait.
    since: Time,
    stalls: Vec<Stall>,
}

#[derive(Clone, Copy)]
enum Event {
    /// The head of a message reaches its next channel.
    Head(u32),
    /// A lane for which messages wait is free.
    Free(u32),
    /// A message has arrived completely.
    Arrive(u32),
}

impl Wormhole {
    /// An empty network.
    pub fn new(software: LogGpParameters, links: LinkParameters, topology: &Topology) -> Wormhole {
        let channels = Channels::of(topology);
        let count = channels.count();
        let torus = matches!(topology.shape(), Shape::Torus { .. });
        let second_lanes = torus && links.virtual_channels > 1;
        let lanes = if second_lanes { 2 * count } else { count };
        Wormhole {
            software,
            links,
            topology: topology.clone(),
            channels,
            lanes: (0..lanes).map(|_| Lane::default()).collect(),
            second_lanes,
            uses: vec![Use::default(); count],
            worms: Vec::new(),
            idle_worms: Vec::new(),
            events: EventQueue::default(),
            waiting: 0,
        }
    }

    /// Adds a message. Returns its number, which it may take over from one that has arrived.
    fn worm(&mut self, message: Message) -> u32 {
        let number = self.idle_worms.pop().unwrap_or(self.worms.len() as u32);
        if number as usize == self.worms.len() {
            let (since, path, stalls) = (Time::ZERO, Vec::new(), Vec::new());
            self.worms.push(Worm { message, path, taken: 0, left: 0, since, stalls });
        }
        let worm = &mut self.worms[number as usize];
        (worm.message, worm.taken, worm.left) = (message, 0, 0);
        worm.path.clear();
        let mut add = |channel, second: bool| {
            let second = if second { self.channels.count() } else { 0 };
            worm.path.push(((self.channels.number(channel) + second) as u32, Time::ZERO));
        };
        add(Channel::Injection(message.from), false);
        for hop in self.topology.route(message.from, message.to) {
            add(Channel::Link(hop.link), hop.wrapped && self.second_lanes);
        }
        add(Channel::Ejection(message.to), false);
        number
    }

    /// The channel of a lane, by number.
    fn channel_of(&self, lane: u32) -> usize {
        lane as usize % self.channels.count()
    }

    /// The head of a message has reached its next lane: takes it, or waits in the queue.
    fn request(&mut self, number: u32, now: Time) {
        let worm = &mut self.worms[number as usize];
        let lane_number = worm.path[worm.taken].0;
        let lane = &mut self.lanes[lane_number as usize];
        if lane.holder.is_none() && lane.queue.is_empty() {
            if lane.free <= now {
                return self.take(number, now);
            }
            self.events.schedule(lane.free, Event::Free(lane_number));
        }
        worm.since = now;
        lane.queue.push_back(number);
        self.waiting += 1;
    }

    /// The first message in the queue gets a lane.
    fn grant(&mut self, lane_number: u32, now: Time) {
        let channel = self.channels.channel(self.channel_of(lane_number));
        let lane = &mut self.lanes[lane_number as usize];
        let Some(number) = lane.queue.pop_front() else { return };
        self.waiting -= 1;
        let worm = &mut self.worms[number as usize];
        worm.stalls.extend(lane.past_holders.stalls(channel, worm.since));
        self.take(number, now);
    }

    /// The head of a message enters the next lane of its path.
    fn take(&mut self, number: u32, now: Time) {
        let worm = &mut self.worms[number as usize];
        let step = worm.taken;
        let lane = &mut self.lanes[worm.path[step].0 as usize];
        debug_assert!(lane.holder.is_none() && lane.free <= now, "two messages in a lane");
        lane.holder = Some(number);
        if lane.queue.is_empty() {
            lane.past_holders.forget(now);
        }
        worm.path[step].1 = now;
        worm.taken += 1;
        let bytes = worm.message.bytes;
        if worm.taken == worm.path.len() {
            return self.stream(number, now);
        }
        self.shrink(number, now);
        let until_next = match step {
            0 => self.links.gathering(&self.software, bytes),
            _ => self.software.hop_time,
        };
        match until_next {
            Duration::ZERO => self.request(number, now),
            span => self.events.schedule(now + span, Event::Head(number)),
        }
    }

    /// The tail of a short message leaves lanes, because the buffers behind its head hold all of it. It
    /// never leaves the lane that its head entered last: a buffer holds one message at a time.
    fn shrink(&mut self, number: u32, now: Time) {
        let worm = &self.worms[number as usize];
        let flits = self.links.flits(worm.message.bytes);
        let span = flits.div_ceil(self.links.buffer_flits.into()).max(2);
        let passage = self.links.passage(worm.message.bytes);
        for step in worm.left..(worm.taken + 1).saturating_sub(span as usize) {
            let worm = &self.worms[number as usize];
            let gathering = match step {
                0 => self.links.gathering(&self.software, worm.message.bytes),
                _ => Duration::ZERO,
            };
            let passed = worm.path[step].1 + gathering + passage;
            self.leave(number, step, now.max(passed));
        }
    }

    /// The head of a message has arrived: its bytes follow, and its tail leaves one lane after another.
    fn stream(&mut self, number: u32, now: Time) {
        let worm = &self.worms[number as usize];
        let (steps, left, message) = (worm.path.len(), worm.left, worm.message);
        let mut start = now;
        if self.second_lanes {
            // The other lane's bytes go first.
            let passed = worm.path.iter().map(|step| self.uses[self.channel_of(step.0)].passed);
            start = passed.fold(start, Time::max);
        }
        let done = start + self.links.passage(message.bytes);
        for step in left..steps {
            // From the port the tail crosses as many links as from the first link.
            let ahead = (steps - 1 - step.max(1)) as u64;
            let tail = Time::ZERO + ((done - Time::ZERO) - self.software.hop_time * ahead);
            self.leave(number, step, tail.max(now));
        }
        self.events.schedule(done + self.software.latency, Event::Arrive(number));
    }

    /// The tail of a message leaves a lane of its path at `until`.
    fn leave(&mut self, number: u32, step: usize, until: Time) {
        let worm = &mut self.worms[number as usize];
        let (lane_number, since) = worm.path[step];
        worm.left = step + 1;
        let gap = if step == 0 { self.software.gap } else { Duration::ZERO };
        let channel = lane_number as usize % self.channels.count();
        let channel = &mut self.uses[channel];
        channel.messages += 1;
        channel.held += until - since;
        channel.carrying += self.links.passage(worm.message.bytes);
        channel.passed = channel.passed.max(until);
        let lane = &mut self.lanes[lane_number as usize];
        lane.holder = None;
        lane.free = until + gap;
        lane.past_holders.left(worm.message.id, lane.free);
        if !lane.queue.is_empty() {
            self.events.schedule(lane.free, Event::Free(lane_number));
        }
    }

    /// No event is left and messages wait: finds the circle.
    fn deadlock(&self) -> Deadlock {
        let waits = |number: u32| {
            let worm = &self.worms[number as usize];
            let lane = worm.path[worm.taken].0;
            let channel = self.channels.channel(self.channel_of(lane));
            let holder = self.lanes[lane as usize].holder?;
            Some((worm.message, channel, holder))
        };
        let stuck = self.lanes.iter().find_map(|lane| lane.queue.front());
        Deadlock::find(stuck.copied().unwrap_or_default(), &self.topology, waits)
    }
}

impl Network for Wormhole {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let sender_free = now + self.software.send_overhead;
        let worm = self.worm(message);
        self.events.schedule(sender_free, Event::Head(worm));
        sender_free
    }

    fn receive_overhead(&self) -> Duration {
        self.software.receive_overhead
    }

    fn next_event(&self) -> Option<Time> {
        self.events.next_time()
    }

    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock> {
        while let Some((at, event)) = self.events.take_due(now) {
            match event {
                Event::Head(worm) => self.request(worm, at),
                Event::Free(lane) => self.grant(lane, at),
                Event::Arrive(number) => {
                    let worm = &mut self.worms[number as usize];
                    let stalls = std::mem::take(&mut worm.stalls);
                    arrived.push(Arrival { message: worm.message, at, stalls });
                    self.idle_worms.push(number);
                }
            }
        }
        match self.waiting > 0 && self.events.next_time().is_none() {
            true => Err(self.deadlock()),
            false => Ok(()),
        }
    }

    fn channel_use(&self) -> Vec<ChannelUse> {
        let uses = self.uses.iter().enumerate();
        uses.map(|(number, &Use { messages, held, carrying, .. })| ChannelUse {
            channel: self.channels.channel(number),
            messages,
            carrying,
            held,
        })
        .collect()
    }
}
