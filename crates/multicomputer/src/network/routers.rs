//! Routers of the model `flit`: buffers and virtual channels, cycle by cycle.

use std::collections::{BTreeSet, VecDeque};
use std::ops::Range;

use desim::{Duration, Time};

use super::channel::{Channel, Channels};
use super::deadlock::Deadlock;
use super::links::LinkParameters;
use super::message::Message;
use super::network::{ChannelUse, Stall};
use super::topology::{Shape, Topology};

/// The routers of a network, and the messages in them.
pub(crate) struct Routers {
    links: LinkParameters,
    topology: Topology,
    channels: Channels,
    cycle: Duration,
    hop_cycles: u64,
    flight: u64,
    /// By channel, one for each virtual channel; injections and ejections use only the first.
    lanes: Vec<Lane>,
    /// Lanes with flits in their buffers.
    occupied: BTreeSet<u32>,
    uses: Vec<Use>,
    worms: Vec<Worm>,
    idle_worms: Vec<u32>,
    /// Until this cycle something happens although no flit moves: a stage ends, or room returns.
    busy_until: u64,
}

/// A virtual channel and the buffer at its end.
#[derive(Default)]
struct Lane {
    /// The message that holds the virtual channel, and since which cycle.
    owner: Option<(u32, u64)>,
    buffer: VecDeque<FlitOfWorm>,
    /// The cycles in which room comes back that flits have left.
    returning: VecDeque<u64>,
    /// The cycle in which the flit at the front arrived there.
    front_since: u64,
    /// The next lane of the message at the front, and from which cycle its flits can leave.
    onward: Option<(u32, u64)>,
    /// The cycle in which the buffer last sent a flit.
    served: u64,
}

#[derive(Clone, Copy)]
struct FlitOfWorm {
    worm: u32,
    /// Its position on its path.
    step: u32,
    first: bool,
    last: bool,
    /// The cycle in which it can leave.
    ready: u64,
}

/// The use of a channel.
#[derive(Clone, Copy, Default)]
struct Use {
    messages: u64,
    flits: u64,
    held: Duration,
    /// The cycle, plus one, in which a flit last passed, and in which its buffers last sent one.
    came: u64,
    gave: u64,
    /// The message of the flit that last passed, for those that lost arbitration to it.
    by: u32,
}

/// A message in the network: a worm of flits.
pub(crate) struct Worm {
    pub(crate) message: Message,
    pub(crate) flits: u64,
    /// Its waits for other messages.
    pub(crate) stalls: Vec<Stall>,
    /// Its channels, each with the lanes that it may use.
    path: Vec<(usize, Range<u32>)>,
}

impl Worm {
    /// Links of its path.
    pub(crate) fn hops(&self) -> u64 {
        self.path.len() as u64 - 2
    }
}

/// The result of a cycle.
pub(crate) struct Step {
    /// Whether a flit moved, or something else is under way in a router.
    pub(crate) alive: bool,
    /// Messages whose last flit has left the network.
    pub(crate) out: Vec<u32>,
}

impl Routers {
    /// Empty routers.
    pub(crate) fn new(links: LinkParameters, hop_time: Duration, topology: &Topology) -> Routers {
        let channels = Channels::of(topology);
        let count = channels.count();
        let lanes = count * links.virtual_channels as usize;
        Routers {
            topology: topology.clone(),
            channels,
            cycle: links.cycle(),
            hop_cycles: links.cycles(hop_time),
            flight: links.flight(hop_time),
            links,
            lanes: (0..lanes).map(|_| Lane::default()).collect(),
            occupied: BTreeSet::new(),
            uses: vec![Use::default(); count],
            worms: Vec::new(),
            idle_worms: Vec::new(),
            busy_until: 0,
        }
    }

    /// The part of a hop's time beyond whole cycles.
    pub(crate) fn rest(&self, hop_time: Duration) -> Duration {
        hop_time - self.cycle * self.hop_cycles
    }

    /// Adds a message that will be injected. Returns its number.
    pub(crate) fn add(&mut self, message: Message) -> u32 {
        let mut path = vec![self.way(Channel::Injection(message.from), false)];
        let hops = self.topology.route(message.from, message.to);
        path.extend(hops.into_iter().map(|hop| self.way(Channel::Link(hop.link), hop.wrapped)));
        path.push(self.way(Channel::Ejection(message.to), false));
        let flits = self.links.flits(message.bytes);
        let worm = Worm { message, flits, path, stalls: Vec::new() };
        let Some(number) = self.idle_worms.pop() else {
            self.worms.push(worm);
            return self.worms.len() as u32 - 1;
        };
        self.worms[number as usize] = worm;
        number
    }

    /// A message in the network, by number.
    pub(crate) fn worm(&mut self, number: u32) -> &mut Worm {
        &mut self.worms[number as usize]
    }

    /// A message has arrived: its number can be reused.
    pub(crate) fn retire(&mut self, number: u32) {
        self.idle_worms.push(number);
    }

    /// A channel's number and its lanes for messages that have passed the start of a ring, or have not.
    fn way(&self, channel: Channel, wrapped: bool) -> (usize, Range<u32>) {
        let number = self.channels.number(channel);
        let lanes = self.links.virtual_channels;
        let first = number as u32 * lanes;
        let half = lanes / 2;
        let of_torus = matches!(self.topology.shape(), Shape::Torus { .. }) && lanes > 1;
        let lanes = match channel {
            Channel::Injection(_) | Channel::Ejection(_) => first..first + 1,
            Channel::Link(_) if !of_torus => first..first + lanes,
            Channel::Link(_) if wrapped => first + half..first + lanes,
            Channel::Link(_) => first..first + half,
        };
        (number, lanes)
    }

    /// Whether all buffers are empty.
    pub(crate) fn are_empty(&self) -> bool {
        self.occupied.is_empty()
    }

    /// Injects flit number `flit` of a message, if there is room.
    pub(crate) fn inject(&mut self, worm: u32, flit: u64, now: u64) -> bool {
        let Worm { flits, path, .. } = &self.worms[worm as usize];
        let (channel, lane) = (path[0].0, path[0].1.start);
        if !self.has_room(lane, now) {
            return false;
        }
        let (first, last) = (flit == 0, flit + 1 == *flits);
        self.put(lane, FlitOfWorm { worm, step: 0, first, last, ready: now });
        self.uses[channel].flits += 1;
        true
    }

    /// The last flit of a message is injected, after it has held its sender's port for `held`.
    pub(crate) fn injected(&mut self, worm: u32, held: Duration) {
        let channel = &mut self.uses[self.worms[worm as usize].path[0].0];
        channel.messages += 1;
        channel.held += held;
    }

    /// Whether the sender of a lane knows of room in its buffer.
    fn has_room(&self, lane: u32, now: u64) -> bool {
        let lane = &self.lanes[lane as usize];
        let returning = lane.returning.iter().filter(|&&cycle| cycle > now).count();
        lane.buffer.len() + returning < self.links.buffer_flits as usize
    }

    /// A flit enters a buffer.
    fn put(&mut self, number: u32, flit: FlitOfWorm) {
        let lane = &mut self.lanes[number as usize];
        if lane.buffer.is_empty() {
            lane.front_since = flit.ready;
        }
        lane.buffer.push_back(flit);
        self.busy_until =
            self.busy_until.max(lane.front_since.saturating_add(self.links.stages.routing));
        self.occupied.insert(number);
    }

    /// Simulates a cycle: allocates virtual channels to heads, then moves flits.
    pub(crate) fn step(&mut self, now: u64) -> Step {
        self.allocate(now);
        let moves = self.choose_moves(now);
        let alive = now < self.busy_until || !moves.is_empty();
        let out = moves.into_iter().filter_map(|lane| self.forward(lane, now)).collect();
        Step { alive, out }
    }

    /// Allocates virtual channels to heads at the front of buffers.
    fn allocate(&mut self, now: u64) {
        let stages = self.links.stages;
        let mut asking = Vec::new();
        for &number in &self.occupied {
            let lane = &self.lanes[number as usize];
            let Some(front) = lane.buffer.front() else { continue };
            if front.first
                && lane.front_since.saturating_add(stages.routing) <= now
                && lane.onward.is_none()
            {
                asking.push((lane.front_since, number, *front));
            }
        }
        asking.sort_unstable_by_key(|&(since, lane, _)| (since, lane));
        for (_, lane, FlitOfWorm { worm, step, .. }) in asking {
            let (channel, lanes) = self.worms[worm as usize].path[step as usize + 1].clone();
            let mut free = lanes.clone().filter(|&l| self.lanes[l as usize].owner.is_none());
            if let Some(free) = free.next() {
                self.lanes[free as usize].owner = Some((worm, now));
                let from = now.saturating_add(stages.allocation);
                self.lanes[lane as usize].onward = Some((free, from));
                self.busy_until = self.busy_until.max(from);
            } else if let Some((by, _)) = self.lanes[lanes.start as usize].owner {
                self.stall(worm, channel, by);
            }
        }
    }

    /// A message waits a cycle for another.
    fn stall(&mut self, worm: u32, channel: usize, by: u32) {
        let by = self.worms[by as usize].message.id;
        let stalls = &mut self.worms[worm as usize].stalls;
        let channel = self.channels.channel(channel);
        match stalls.last_mut() {
            Some(last) if (last.channel, last.by) == (channel, by) => last.span += self.cycle,
            _ => stalls.push(Stall { channel, by, span: self.cycle }),
        }
    }

    /// Chooses the buffers that send a flit, by the state before any of them does.
    fn choose_moves(&mut self, now: u64) -> Vec<u32> {
        let mut able = Vec::new();
        for &number in &self.occupied {
            let lane = &self.lanes[number as usize];
            let Some((front, (onward, from))) = lane.buffer.front().zip(lane.onward) else {
                continue;
            };
            if front.ready.max(from) <= now && self.has_room(onward, now) {
                able.push((lane.served, number, onward, front.worm));
            }
        }
        able.sort_unstable();
        let virtual_channels = self.links.virtual_channels;
        let mut moves = Vec::new();
        for (_, lane, onward, worm) in able {
            let [from, to] = [lane, onward].map(|lane| (lane / virtual_channels) as usize);
            if self.uses[to].came > now {
                self.stall(worm, to, self.uses[to].by);
            } else if self.uses[from].gave <= now {
                self.uses[from].gave = now.saturating_add(1);
                (self.uses[to].came, self.uses[to].by) = (now.saturating_add(1), worm);
                moves.push(lane);
            }
        }
        moves
    }

    /// Moves the flit at the front of a buffer. Returns its message if that has left the network.
    fn forward(&mut self, number: u32, now: u64) -> Option<u32> {
        let lane = &mut self.lanes[number as usize];
        let (flit, (onward, _)) = lane.buffer.pop_front().zip(lane.onward)?;
        lane.served = now;
        let next = lane.buffer.front();
        lane.front_since = next.map_or(0, |front| front.ready.max(now.saturating_add(1)));
        let room = now.saturating_add(self.links.stages.credit);
        lane.returning.retain(|&cycle| cycle > now);
        lane.returning.push_back(room);
        let asks = lane.front_since.saturating_add(self.links.stages.routing);
        self.busy_until = self.busy_until.max(room).max(asks);
        if lane.buffer.is_empty() {
            self.occupied.remove(&number);
        }
        let used = &mut self.uses[(onward / self.links.virtual_channels) as usize];
        used.flits += 1;
        if flit.last {
            self.lanes[number as usize].onward = None;
            let owner = self.lanes[onward as usize].owner.take();
            let cycles = owner.map_or(0, |(_, since)| now - since + 1);
            used.messages += 1;
            used.held += self.cycle * cycles;
        }
        let step = flit.step + 1;
        if step as usize + 1 == self.worms[flit.worm as usize].path.len() {
            return flit.last.then_some(flit.worm);
        }
        self.put(onward, FlitOfWorm { step, ready: now.saturating_add(self.flight), ..flit });
        None
    }

    /// No flit can move: the circle of waiting messages.
    pub(crate) fn deadlock(&self) -> Deadlock {
        let waits = |number: u32| {
            let worm = &self.worms[number as usize];
            // The message's first flit is at the front and needs a lane, or is behind another message.
            let lane = self.occupied.iter().filter_map(|&lane| {
                let lane = &self.lanes[lane as usize];
                let flit = lane.buffer.iter().find(|flit| flit.worm == number)?;
                Some((flit.step, lane))
            });
            let (step, lane) = lane.max_by_key(|(step, _)| *step)?;
            let (next, lanes) = worm.path[step as usize + 1].clone();
            let (here, _) = worm.path[step as usize];
            let front = lane.buffer.front()?.worm;
            let (channel, holder) = match front == number {
                true => (next, self.lanes[lanes.start as usize].owner?.0),
                false => (here, front),
            };
            Some((worm.message, self.channels.channel(channel), holder))
        };
        let front = |lane: &u32| self.lanes[*lane as usize].buffer.front();
        let stuck = self.occupied.iter().find_map(front).map_or(0, |flit| flit.worm);
        Deadlock::find(stuck, &self.topology, waits)
    }

    /// The use of each channel until now.
    pub(crate) fn channel_use(&self) -> Vec<ChannelUse> {
        let uses = self.uses.iter().enumerate();
        uses.map(|(number, &Use { messages, flits, held, .. })| ChannelUse {
            channel: self.channels.channel(number),
            messages,
            carrying: self.cycle * flits,
            held,
        })
        .collect()
    }

    /// The time at which a cycle ends.
    pub(crate) fn end(&self, cycle: u64) -> Time {
        Time::ZERO + self.cycle * cycle.saturating_add(1)
    }

    /// The first cycle that does not begin before `time`.
    pub(crate) fn cycle_from(&self, time: Time) -> u64 {
        time.0.div_ceil(self.cycle.0)
    }
}
