//! The model `flit`: wormhole routing, flit by flit and cycle by cycle. Slow and simple, it is the reference
//! for the faster models.
//!
//! A router has a buffer for each incoming virtual channel. In every cycle
//! 1. each node's port puts a flit of the message that it sends into its router, if there is room;
//! 2. each head that has been at the front of a buffer for the cycles of routing gets a virtual channel
//!    of the channel that its route takes next, if one is free: first come, first served, and the
//!    lower number where two came at once. It can leave after the cycles of allocation;
//! 3. each channel transfers at most one flit, and of the buffers of each channel at most one sends a
//!    flit: of those with room ahead, the one served longest ago. A head can leave the next buffer
//!    `hop_time` later, rounded down to cycles, at least one; the remainder is added when the
//!    message arrives. Other flits save the cycles of routing and allocation. A node receives a flit a cycle.
//!
//! Choice C21: the details of a Paragon's router are unpublished; this is the simplest one with all of
//! these mechanisms. Its heads are routed and allocated in the cycle in which they leave.
//!
//! A virtual channel is free again when the tail has passed it. Room in a buffer can be used when the
//! credit is back: `credit` cycles after the flit has left.
//!
//! A message passes one router more than links. The stages of the first one are part of the latency.

use std::collections::VecDeque;

use desim::{Duration, EventQueue, Time};

use super::channel::Channel;
use super::deadlock::Deadlock;
use super::links::LinkParameters;
use super::loggp::LogGpParameters;
use super::message::Message;
use super::network::{Arrival, ChannelUse, Network, Stall};
use super::routers::Routers;
use super::topology::Topology;

/// A network of routers, with a port for every node.
pub struct Flit {
    software: LogGpParameters,
    links: LinkParameters,
    routers: Routers,
    /// The part of the latency that passes outside the routers.
    outside: Duration,
    /// Number of the next cycle.
    next: u64,
    ports: Vec<Port>,
    /// Messages that reach their port at the end of the send overhead.
    sent: EventQueue<u32>,
    arrivals: EventQueue<u32>,
}

/// A node's port.
#[derive(Default)]
struct Port {
    /// Waiting messages, with the start of their wait.
    queue: VecDeque<(u32, Time)>,
    sending: Option<Sending>,
    /// When it can start the next message.
    free: Time,
    /// The last message.
    last: u64,
}

/// A message that a port injects.
#[derive(Clone, Copy)]
struct Sending {
    worm: u32,
    flits: u64,
    /// Start of the injection.
    since: Time,
    /// The earliest cycle of the first flit.
    from: u64,
    /// Flits already in the network.
    gone: u64,
}

impl Flit {
    /// An empty network.
    pub fn new(software: LogGpParameters, links: LinkParameters, topology: &Topology) -> Flit {
        let first_router = links.cycle() * links.stages.of_head();
        Flit {
            outside: software.latency - first_router,
            routers: Routers::new(links.clone(), software.hop_time, topology),
            software,
            links,
            next: 0,
            ports: (0..topology.places()).map(|_| Port::default()).collect(),
            sent: EventQueue::default(),
            arrivals: EventQueue::default(),
        }
    }

    /// Starts the next waiting message of a port that is free.
    fn start_next(&mut self, place: usize) {
        let port = &mut self.ports[place];
        if port.sending.is_some() {
            return;
        }
        let Some((number, asked)) = port.queue.pop_front() else { return };
        let worm = self.routers.worm(number);
        let (message, flits) = (worm.message, worm.flits);
        let since = asked.max(port.free);
        if since > asked {
            let channel = Channel::Injection(message.from);
            worm.stalls.push(Stall { channel, by: port.last, span: since - asked });
        }
        port.last = message.id;
        let gathered = since + self.links.gathering(&self.software, message.bytes);
        let from = self.routers.cycle_from(gathered);
        port.sending = Some(Sending { worm: number, flits, since, from, gone: 0 });
    }

    /// The next cycle in which a flit can move; none if the network is empty. It is simulated at its end, so
    /// that messages sent at its beginning are part of it.
    fn next_cycle(&self) -> Option<u64> {
        if !self.routers.are_empty() {
            return Some(self.next);
        }
        let starts = self.ports.iter().filter_map(|port| port.sending.map(|s| s.from));
        starts.min().map(|from| from.max(self.next))
    }

    /// Simulates a cycle. Returns whether a flit moved, or something else is under way in a router.
    fn step(&mut self, now: u64) -> bool {
        self.next = now.saturating_add(1);
        let mut alive = false;
        for place in 0..self.ports.len() {
            alive |= self.inject(place, now);
        }
        let step = self.routers.step(now);
        let rest = self.routers.rest(self.software.hop_time);
        for number in step.out {
            let way = rest * self.routers.worm(number).hops() + self.outside;
            self.arrivals.schedule(self.routers.end(now) + way, number);
        }
        alive || step.alive
    }

    /// A port injects a flit, if it can. Returns whether it did.
    fn inject(&mut self, place: usize, now: u64) -> bool {
        let Some(sending) = &mut self.ports[place].sending else { return false };
        let Sending { worm, flits, since, from, gone } = *sending;
        if from > now || !self.routers.inject(worm, gone, now) {
            return false;
        }
        sending.gone += 1;
        if gone + 1 == flits {
            let end = self.routers.end(now);
            self.routers.injected(worm, end - since);
            self.ports[place].free = end + self.software.gap;
            self.ports[place].sending = None;
            self.start_next(place);
        }
        true
    }
}

impl Network for Flit {
    fn send(&mut self, now: Time, message: Message) -> Time {
        let sender_free = now + self.software.send_overhead;
        let worm = self.routers.add(message);
        self.sent.schedule(sender_free, worm);
        sender_free
    }

    fn receive_overhead(&self) -> Duration {
        self.software.receive_overhead
    }

    fn next_event(&self) -> Option<Time> {
        let cycle = self.next_cycle().map(|cycle| self.routers.end(cycle));
        [self.sent.next_time(), cycle, self.arrivals.next_time()].into_iter().flatten().min()
    }

    fn advance(&mut self, now: Time, arrived: &mut Vec<Arrival>) -> Result<(), Deadlock> {
        while let Some(time) = self.next_event().filter(|&time| time <= now) {
            while let Some((at, number)) = self.sent.take_due(time) {
                let place = self.routers.worm(number).message.from.index();
                self.ports[place].queue.push_back((number, at));
                self.start_next(place);
            }
            if let Some(cycle) = self.next_cycle().filter(|&cycle| self.routers.end(cycle) <= time)
                && !self.step(cycle)
            {
                return Err(self.routers.deadlock());
            }
            while let Some((at, number)) = self.arrivals.take_due(time) {
                let worm = self.routers.worm(number);
                let (message, stalls) = (worm.message, std::mem::take(&mut worm.stalls));
                arrived.push(Arrival { message, at, stalls });
                self.routers.retire(number);
            }
        }
        Ok(())
    }

    fn channel_use(&self) -> Vec<ChannelUse> {
        self.routers.channel_use()
    }
}
