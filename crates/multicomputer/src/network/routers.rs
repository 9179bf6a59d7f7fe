//! Routers: buffers, virtual channels, and the flits that pass through them, cycle by cycle.

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
    /// By channel, as many for each as there are virtual channels; injections and ejections use one.
    lanes: Vec<Lane>,
    /// Lanes with flits in their buffers.
    occupied: BTreeSet<u32>,
    uses: Vec<Use>,
    worms: Vec<Worm>,
    idle_worms: Vec<u32>,
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

/// A message in the network.
pub(crate) struct Worm {
    pub(crate) message: Message,
    pub(crate) flits: u64,
    /// How other messages have held it up.
    pub(crate) stalls: Vec<Stall>,
    /// Its channels, each with the lanes of it that it may have.
    path: Vec<(usize, Range<u32>)>,
}

impl Worm {
    /// Links of its path.
    pub(crate) fn hops(&self) -> u64 {
        self.path.len() as u64 - 2
    }
}

/// What a cycle did.
pub(crate) struct Step {
    /// Whether anything moved, or is on its way through a router.
    pub(crate) alive: bool,
    /// Worms whose last flit has left the network.
    pub(crate) out: Vec<u32>,
}

impl Routers {
    /// Routers with nothing in them.
    pub(crate) fn new(links: LinkParameters, hop_time: Duration, topology: &Topology) -> Routers {
        let channels = Channels::of(topology);
        let count = channels.count();
        let lanes = count * links.virtual_channels as usize;
        Routers {
            topology: topology.clone(),
            channels,
            cycle: links.cycle(),
            hop_cycles: links.cycles(hop_time),
            links,
            lanes: (0..lanes).map(|_| Lane::default()).collect(),
            occupied: BTreeSet::new(),
            uses: vec![Use::default(); count],
            worms: Vec::new(),
            idle_worms: Vec::new(),
        }
    }

    /// What of a hop's time the cycles leave over.
    pub(crate) fn rest(&self, hop_time: Duration) -> Duration {
        hop_time - self.cycle * self.hop_cycles
    }

    /// A worm for a message that is going to be put in.
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

    /// A worm that is under way.
    pub(crate) fn worm(&mut self, number: u32) -> &mut Worm {
        &mut self.worms[number as usize]
    }

    /// A worm has arrived: its number may be given to another.
    pub(crate) fn retire(&mut self, number: u32) {
        self.idle_worms.push(number);
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

    /// Whether no buffer holds anything.
    pub(crate) fn are_empty(&self) -> bool {
        self.occupied.is_empty()
    }

    /// Puts flit number `flit` of a worm into the router of its sender, if there is room.
    pub(crate) fn inject(&mut self, worm: u32, flit: u64, now: u64) -> bool {
        let Worm { flits, path, .. } = &self.worms[worm as usize];
        let (channel, lane) = (path[0].0, path[0].1.start);
        if self.lanes[lane as usize].buffer.len() >= self.links.buffer_flits as usize {
            return false;
        }
        let (first, last) = (flit == 0, flit + 1 == *flits);
        self.put(lane, FlitOfWorm { worm, step: 0, first, last, ready: now });
        self.uses[channel].flits += 1;
        true
    }

    /// The last flit of a worm has gone in, which has held its sender's port for so long.
    pub(crate) fn injected(&mut self, worm: u32, held: Duration) {
        let channel = &mut self.uses[self.worms[worm as usize].path[0].0];
        channel.messages += 1;
        channel.held += held;
    }

    /// A flit comes to a buffer.
    fn put(&mut self, number: u32, flit: FlitOfWorm) {
        let lane = &mut self.lanes[number as usize];
        if lane.buffer.is_empty() {
            lane.front_since = flit.ready;
        }
        lane.buffer.push_back(flit);
        self.occupied.insert(number);
    }

    /// A cycle: heads get virtual channels, then flits move on.
    pub(crate) fn step(&mut self, now: u64) -> Step {
        let under_way = self.allocate(now);
        let moves = self.choose_moves(now);
        let alive = under_way || !moves.is_empty();
        let out = moves.into_iter().filter_map(|lane| self.pass_on(lane, now)).collect();
        Step { alive, out }
    }

    /// Heads at the front of buffers get virtual channels. Says whether a flit is still on its way to
    /// the front of a buffer.
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
            let mut free = lanes.clone().filter(|&l| self.lanes[l as usize].owner.is_none());
            if let Some(free) = free.next() {
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

    /// The buffers that give a flit away, by the state before any does.
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
            if self.uses[to].came > now {
                self.hold_up(worm, to, self.uses[to].by);
            } else if self.uses[from].gave <= now {
                self.uses[from].gave = now.saturating_add(1);
                (self.uses[to].came, self.uses[to].by) = (now.saturating_add(1), worm);
                moves.push(lane);
            }
        }
        moves
    }

    /// The flit at the front of a buffer goes on. Returns the worm that is out of the network by it.
    fn pass_on(&mut self, number: u32, now: u64) -> Option<u32> {
        let lane = &mut self.lanes[number as usize];
        let (flit, onward) = lane.buffer.pop_front().zip(lane.onward)?;
        lane.served = now;
        lane.front_since =
            lane.buffer.front().map_or(0, |front| front.ready.max(now.saturating_add(1)));
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
        self.put(onward, FlitOfWorm { step, ready: now.saturating_add(self.hop_cycles), ..flit });
        None
    }

    /// Nothing can move: the circle of those that wait.
    pub(crate) fn deadlock(&self) -> Deadlock {
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
            Some((worm.message, self.channels.channel(channel), holder))
        };
        let front = |lane: &u32| self.lanes[*lane as usize].buffer.front();
        let stuck = self.occupied.iter().find_map(front).map_or(0, |flit| flit.worm);
        Deadlock::find(stuck, &self.topology, waits)
    }

    /// What each channel has done until now.
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

    /// The time at which a cycle begins.
    pub(crate) fn time(&self, cycle: u64) -> Time {
        Time::ZERO + self.cycle * cycle
    }

    /// The first cycle that does not begin before `time`.
    pub(crate) fn cycle_from(&self, time: Time) -> u64 {
        time.0.div_ceil(self.cycle.as_ps())
    }
}
