//! Wormhole routing, flit by flit and cycle by cycle: slow and obvious, the oracle of the other rungs.
//!
//! A router keeps what comes in by each virtual channel in a buffer of its own. In every cycle
//! 1. each node's port puts a flit of the message that it sends into its router, if there is room;
//! 2. each head at the front of a buffer gets a virtual channel of the channel that its route takes
//!    next, if one is free: first come, first served, and the lower number where two came at once;
//! 3. each channel takes one flit on, and each buffer's channel gives one away: of those that have
//!    room ahead, the one that was longest not served. The flit stands at the front of the next
//!    buffer `hop_time` later, rounded down to cycles, at least one; what was rounded off is added
//!    when the message arrives. A node takes in a flit a cycle.
//!
//! A virtual channel is free again when the tail has left by it, and room in a buffer counts one cycle
//! after the flit has gone.

use std::collections::{BTreeSet, VecDeque};
use std::ops::Range;

use desim::{Duration, Time};

use super::channel::{Channel, Channels};
use super::deadlock::Deadlock;
use super::delivery::{Arrival, ChannelUse, Message, Network, Stall};
use super::links::LinkParameters;
use super::loggp::LogGpParameters;
use crate::agenda::Agenda;
use crate::topology::{Shape, Topology};

/// A network of routers.
pub struct Flit {
    software: LogGpParameters,
    links: LinkParameters,
    topology: Topology,
    channels: Channels,
    cycle: Duration,
    hop_cycles: u64,
    /// Number of the next cycle.
    next: u64,
    ports: Vec<Port>,
    /// By channel, as many for each as there are virtual channels; injections and ejections use one.
    lanes: Vec<Lane>,
    /// Lanes with flits in their buffers.
    occupied: BTreeSet<u32>,
    uses: Vec<Use>,
    worms: Vec<Worm>,
    idle_worms: Vec<u32>,
    /// Messages that their senders are through with, when they come to the port.
    sent: Agenda<u32>,
    arrivals: Agenda<u32>,
}

/// A node's port.
#[derive(Default)]
struct Port {
    queue: VecDeque<u32>,
    sending: Option<Sending>,
    /// When it can turn to the next message.
    free: Time,
    /// The last message.
    last: u64,
}

/// A message that a port puts into the network.
#[derive(Clone, Copy)]
struct Sending {
    worm: u32,
    /// Since when.
    since: Time,
    /// The cycle of the first flit at the earliest.
    from: u64,
    /// Flits that are in the network.
    gone: u64,
}

/// A virtual channel, and the buffer at its end.
#[derive(Default)]
struct Lane {
    /// The worm that has the virtual channel, and since which cycle.
    owner: Option<(u32, u64)>,
    buffer: VecDeque<FlitOfWorm>,
    /// The cycle in which the flit at the front came there.
    front_since: u64,
    /// The lane by which the worm at the front goes on.
    onward: Option<u32>,
    /// The cycle in which the buffer last gave a flit away.
    served: u64,
}

#[derive(Clone, Copy)]
struct FlitOfWorm {
    worm: u32,
    /// How far along its path it is.
    step: u32,
    first: bool,
    last: bool,
    /// The cycle in which it can go on.
    ready: u64,
}

/// What a channel has done.
#[derive(Clone, Copy, Default)]
struct Use {
    messages: u64,
    flits: u64,
    held: Duration,
    /// The cycle, plus one, in which a flit last came by, and in which its buffers last gave one.
    came: u64,
    gave: u64,
    /// The worm of the flit that last came by, for those that lost their turn to it.
    by: u32,
}

/// A message on its way.
struct Worm {
    message: Message,
    flits: u64,
    /// Its channels, each with the lanes of it that it may have.
    path: Vec<(usize, Range<u32>)>,
    /// When it came to the port.
    since: Time,
    stalls: Vec<Stall>,
}

impl Flit {
    /// A network with nothing under way.
    pub fn new(software: LogGpParameters, links: LinkParameters, topology: &Topology) -> Flit {
        let channels = Channels::of(topology);
        let count = channels.count();
        let cycle = links.cycle();
        Flit {
            hop_cycles: links.cycles(software.hop_time),
            cycle,
            topology: topology.clone(),
            next: 0,
            ports: (0..topology.places()).map(|_| Port::default()).collect(),
            lanes: (0..count * links.virtual_channels as usize).map(|_| Lane::default()).collect(),
            occupied: BTreeSet::new(),
            uses: vec![Use::default(); count],
            worms: Vec::new(),
            idle_worms: Vec::new(),
            sent: Agenda::default(),
            arrivals: Agenda::default(),
            software,
            links,
            channels,
        }
    }

    fn worm(&mut self, message: Message) -> u32 {
        let mut path = vec![self.way(Channel::Injection(message.from), false)];
        let hops = self.topology.route(message.from, message.to);
        path.extend(hops.into_iter().map(|hop| self.way(Channel::Link(hop.link), hop.wrapped)));
        path.push(self.way(Channel::Ejection(message.to), false));
        let flits = self.links.flits(message.bytes);
        let worm = Worm { message, flits, path, since: Time::ZERO, stalls: Vec::new() };
        match self.idle_worms.pop() {
            Some(number) => {
                self.worms[number as usize] = worm;
                number
            }
            None => {
                self.worms.push(worm);
                self.worms.len() as u32 - 1
            }
        }
    }

    /// A channel, and the lanes of it for messages that have passed the start of a ring, or not.
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

    /// The time at which a cycle begins.
    fn time(&self, cycle: u64) -> Time {
        Time::ZERO + self.cycle * cycle
    }

    /// The first cycle that does not begin before `time`.
    fn cycle_from(&self, time: Time) -> u64 {
        time.0.div_ceil(self.cycle.as_ps())
    }

    /// The port turns to the next message that waits for it.
    fn turn_port(&mut self, place: usize) {
        let port = &mut self.ports[place];
        if port.sending.is_some() {
            return;
        }
        let Some(number) = port.queue.pop_front() else { return };
        let worm = &mut self.worms[number as usize];
        let (asked, since) = (worm.since, worm.since.max(port.free));
        if since > asked {
            let channel = Channel::Injection(worm.message.from);
            worm.stalls.push(Stall { channel, by: port.last, span: since - asked });
        }
        port.last = worm.message.id;
        let gathered = since + self.links.gathering(&self.software, worm.message.bytes);
        let from = self.cycle_from(gathered);
        self.ports[place].sending = Some(Sending { worm: number, since, from, gone: 0 });
    }

    /// The next cycle in which something can move; none if nothing is in the network.
    fn next_cycle(&self) -> Option<u64> {
        if !self.occupied.is_empty() {
            return Some(self.next);
        }
        let starts = self.ports.iter().filter_map(|port| port.sending.map(|s| s.from));
        starts.min().map(|from| from.max(self.next))
    }

    /// A cycle. Says whether anything moved, or is on its way through a router.
    fn step(&mut self, now: u64) -> bool {
        self.next = now + 1;
        let injected = self.inject(now);
        let under_way = self.allocate(now);
        let moves = self.choose_moves(now);
        for &lane in &moves {
            self.pass_on(lane, now);
        }
        injected || under_way || !moves.is_empty()
    }

    /// Step 1: from the nodes' ports into their routers.
    fn inject(&mut self, now: u64) -> bool {
        let mut moved = false;
        for place in 0..self.ports.len() {
            let Some(sending) = self.ports[place].sending.filter(|s| s.from <= now) else {
                continue;
            };
            let Sending { worm, since, gone, .. } = sending;
            let lane = self.worms[worm as usize].path[0].1.start;
            if self.lanes[lane as usize].buffer.len() >= self.links.buffer_flits as usize {
                continue;
            }
            moved = true;
            let last = gone + 1 == self.worms[worm as usize].flits;
            let flit = FlitOfWorm { worm, step: 0, first: gone == 0, last, ready: now };
            self.put(lane, flit, now);
            let used = &mut self.uses[place];
            used.flits += 1;
            let port = &mut self.ports[place];
            port.sending = Some(Sending { gone: gone + 1, ..sending });
            if last {
                let end = Time::ZERO + self.cycle * (now + 1);
                used.messages += 1;
                used.held += end - since;
                port.free = end + self.software.gap;
                port.sending = None;
                self.turn_port(place);
            }
        }
        moved
    }

    /// A flit comes to a buffer.
    fn put(&mut self, lane: u32, flit: FlitOfWorm, now: u64) {
        let end = &mut self.lanes[lane as usize];
        if end.buffer.is_empty() {
            end.front_since = now.max(flit.ready);
        }
        end.buffer.push_back(flit);
        self.occupied.insert(lane);
    }

    /// Step 2: heads at the front of buffers get virtual channels. Says whether a flit is still on
    /// its way to the front of a buffer.
    fn allocate(&mut self, now: u64) -> bool {
        let mut under_way = false;
        let mut asking = Vec::new();
        for &number in &self.occupied {
            let lane = &self.lanes[number as usize];
            let Some(front) = lane.buffer.front() else { continue };
            under_way |= front.ready > now;
            if front.first && front.ready <= now && lane.onward.is_none() {
                asking.push((lane.front_since, number, *front));
            }
        }
        asking.sort_unstable_by_key(|&(since, lane, _)| (since, lane));
        for (_, lane, FlitOfWorm { worm, step, .. }) in asking {
            let (channel, lanes) = self.worms[worm as usize].path[step as usize + 1].clone();
            let mut lanes_free = lanes.clone().filter(|&l| self.lanes[l as usize].owner.is_none());
            if let Some(free) = lanes_free.next() {
                self.lanes[free as usize].owner = Some((worm, now));
                self.lanes[lane as usize].onward = Some(free);
            } else if let Some((by, _)) = self.lanes[lanes.start as usize].owner {
                self.hold_up(worm, channel, by);
            }
        }
        under_way
    }

    /// A worm loses a cycle to another.
    fn hold_up(&mut self, worm: u32, channel: usize, by: u32) {
        let by = self.worms[by as usize].message.id;
        let stalls = &mut self.worms[worm as usize].stalls;
        let channel = self.channels.channel(channel);
        match stalls.last_mut() {
            Some(last) if (last.channel, last.by) == (channel, by) => last.span += self.cycle,
            _ => stalls.push(Stall { channel, by, span: self.cycle }),
        }
    }

    /// Step 3: the buffers that give a flit away, by the state before any does.
    fn choose_moves(&mut self, now: u64) -> Vec<u32> {
        let room = self.links.buffer_flits as usize;
        let mut able = Vec::new();
        for &number in &self.occupied {
            let lane = &self.lanes[number as usize];
            let Some((front, onward)) = lane.buffer.front().zip(lane.onward) else { continue };
            if front.ready <= now && self.lanes[onward as usize].buffer.len() < room {
                able.push((lane.served, number, onward, front.worm));
            }
        }
        able.sort_unstable();
        let virtual_channels = self.links.virtual_channels;
        let mut moves = Vec::new();
        for (_, lane, onward, worm) in able {
            let [from, to] = [lane, onward].map(|lane| (lane / virtual_channels) as usize);
            if self.uses[to].came == now + 1 {
                self.hold_up(worm, to, self.uses[to].by);
            } else if self.uses[from].gave <= now {
                self.uses[from].gave = now + 1;
                (self.uses[to].came, self.uses[to].by) = (now + 1, worm);
                moves.push(lane);
            }
        }
        moves
    }

    /// The flit at the front of a buffer goes on.
    fn pass_on(&mut self, number: u32, now: u64) {
        let lane = &mut self.lanes[number as usize];
        let Some((flit, onward)) = lane.buffer.pop_front().zip(lane.onward) else { return };
        lane.served = now;
        lane.front_since = lane.buffer.front().map_or(0, |front| front.ready.max(now + 1));
        if lane.buffer.is_empty() {
            self.occupied.remove(&number);
        }
        let channel = (onward / self.links.virtual_channels) as usize;
        let used = &mut self.uses[channel];
        used.flits += 1;
        if flit.last {
            self.lanes[number as usize].onward = None;
            let owner = self.lanes[onward as usize].owner.take();
            let cycles = owner.map_or(0, |(_, since)| now + 1 - since);
            used.messages += 1;
            used.held += self.cycle * cycles;
        }
        let step = flit.step + 1;
        let worm = &self.worms[flit.worm as usize];
        if step as usize + 1 < worm.path.len() {
            let ready = now + self.hop_cycles;
            self.put(onward, FlitOfWorm { step, ready, ..flit }, now);
        } else if flit.last {
            let rest = self.software.hop_time - self.cycle * self.hop_cycles;
            let hops = worm.path.len() as u64 - 2;
            let way = rest * hops + self.software.latency;
            self.arrivals.enter(self.time(now + 1) + way, flit.worm);
        }
    }

    /// Nothing can move: the circle of those that wait.
    fn deadlock(&self) -> Deadlock {
        let waits = |number: u32| {
            let worm = &self.worms[number as usize];
            // The worm's foremost flit stands at the front and wants a lane, or behind another worm.
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
            let channel = self.channels.channel(channel);
            Some((worm.message, channel, holder))
        };
        let front = |lane: &u32| self.lanes[*lane as usize].buffer.front();
        let stuck = self.occupied.iter().find_map(front).map_or(0, |flit| flit.worm);
        Deadlock::find(stuck, &self.topology, waits)
    }
}

impl Network for Flit {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let sender_free = now + self.software.send_overhead;
        let worm = self.worm(message);
        self.sent.enter(sender_free, worm);
        sender_free
    }

    fn receive_overhead(&self) -> Duration {
        self.software.receive_overhead
    }

    fn next_event(&self) -> Option<Time> {
        let cycle = self.next_cycle().map(|cycle| self.time(cycle));
        [self.sent.next_time(), cycle, self.arrivals.next_time()].into_iter().flatten().min()
    }

    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock> {
        while let Some(time) = self.next_event().filter(|&time| time <= now) {
            while let Some((at, number)) = self.sent.take_due(time) {
                let worm = &mut self.worms[number as usize];
                worm.since = at;
                let place = worm.message.from.index();
                self.ports[place].queue.push_back(number);
                self.turn_port(place);
            }
            if let Some(cycle) = self.next_cycle().filter(|&cycle| self.time(cycle) <= time)
                && !self.step(cycle)
            {
                return Err(self.deadlock());
            }
            while let Some((at, number)) = self.arrivals.take_due(time) {
                let worm = &mut self.worms[number as usize];
                let stalls = std::mem::take(&mut worm.stalls);
                arrived.push(Arrival { message: worm.message, at, stalls });
                self.idle_worms.push(number);
            }
        }
        Ok(())
    }

    fn channel_use(&self) -> Vec<ChannelUse> {
        let uses = self.uses.iter().enumerate();
        uses.map(|(number, &Use { messages, flits, held, .. })| ChannelUse {
            channel: self.channels.channel(number),
            messages,
            carrying: self.cycle * flits,
            held,
        })
        .collect()
    }
}
