//! PHOLD (Fujimoto 1990): each event schedules another one at a random entity after a random time.
//! Processes of the simulation compared with a bare loop over a heap, which has no processes, names or
//! deadlock reports.

#![allow(missing_docs, reason = "a benchmark has no users")]

use std::cell::{Cell, RefCell};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::rc::Rc;

use desim::{Duration, Handle, Signal, Simulation, Time};
use divan::Bencher;
use divan::counter::ItemsCount;

/// Entities: the compute nodes of the paper's machine.
const ENTITIES: usize = 56;
/// Events of a sample.
const EVENTS: u64 = 100_000;

fn main() {
    divan::main();
}

/// Random numbers (Marsaglia's xorshift64).
struct Random(Cell<u64>);

impl Random {
    fn next(&self) -> u64 {
        let mut x = self.0.get();
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        self.0.set(x);
        x
    }

    /// The entity of the next event, and the time until then: 1 to 1024 ns.
    fn event(&self) -> (usize, Duration) {
        let x = self.next();
        ((x >> 32) as usize % ENTITIES, Duration((x % 1024 + 1) * 1000))
    }
}

/// An entity that sleeps, acts, and sleeps again: one event each.
#[divan::bench]
fn sleeping_processes(bencher: Bencher) {
    bencher.counter(ItemsCount::new(EVENTS)).bench(|| {
        let simulation = Simulation::new();
        let random = Rc::new(Random(Cell::new(1996)));
        for entity in 0..ENTITIES {
            let (handle, random) = (simulation.handle(), random.clone());
            simulation.handle().spawn(entity.to_string(), async move {
                for _ in 0..EVENTS / ENTITIES as u64 {
                    handle.sleep(random.event().1).await;
                }
            });
        }
        simulation.run().map(|end| end.0)
    });
}

/// What entities share.
struct World {
    handle: Handle,
    random: Random,
    left: Cell<u64>,
    inboxes: Vec<(RefCell<u64>, Signal)>,
}

impl World {
    /// Sends an event to some entity, unless all have been sent.
    fn send(self: Rc<World>) {
        let left = self.left.get();
        if left == 0 {
            return;
        }
        self.left.set(left - 1);
        let (to, delay) = self.random.event();
        let world = self.clone();
        self.handle.at(self.handle.now() + delay, move || {
            *world.inboxes[to].0.borrow_mut() += 1;
            world.inboxes[to].1.notify();
        });
    }
}

/// PHOLD proper: an event is a callback that fills an entity's inbox, and wakes its process.
#[divan::bench]
fn phold_of_processes(bencher: Bencher) {
    bencher.counter(ItemsCount::new(EVENTS)).bench(|| {
        let simulation = Simulation::new();
        let handle = simulation.handle();
        let inbox = |i: usize| (RefCell::new(0), Signal::new(&handle, format!("inbox {i}")));
        let world = Rc::new(World {
            handle: handle.clone(),
            random: Random(Cell::new(1996)),
            left: Cell::new(EVENTS),
            inboxes: (0..ENTITIES).map(inbox).collect(),
        });
        for entity in 0..ENTITIES {
            let world = world.clone();
            handle.spawn(entity.to_string(), async move {
                world.clone().send();
                loop {
                    world.inboxes[entity].1.wait().await;
                    for _ in 0..world.inboxes[entity].0.take() {
                        world.clone().send();
                    }
                }
            });
        }
        // At the end no event is left and all entities wait.
        simulation.run().map_err(|stalled| stalled.at.0)
    });
}

/// What entities that are no processes share.
struct Bare {
    random: Random,
    left: Cell<u64>,
    taken: [Cell<u64>; ENTITIES],
}

impl Bare {
    /// Sends an event to some entity, which sends another when it comes, unless all have been sent.
    fn send(self: Rc<Bare>, handle: &Handle) {
        let Some(left) = self.left.get().checked_sub(1) else { return };
        self.left.set(left);
        let (to, delay) = self.random.event();
        let again = handle.clone();
        handle.at(handle.now() + delay, move || {
            self.taken[to].set(self.taken[to].get() + 1);
            self.send(&again);
        });
    }
}

/// PHOLD of the engine alone: an event is a callback, and there is no process.
#[divan::bench]
fn phold_of_callbacks(bencher: Bencher) {
    bencher.counter(ItemsCount::new(EVENTS)).bench(|| {
        let simulation = Simulation::new();
        let bare = Rc::new(Bare {
            random: Random(Cell::new(1996)),
            left: Cell::new(EVENTS),
            taken: [const { Cell::new(0) }; ENTITIES],
        });
        for _ in 0..ENTITIES {
            bare.clone().send(&simulation.handle());
        }
        simulation.run().map(|end| (end.0, bare.taken.each_ref().map(Cell::get)))
    });
}

/// The same events in a loop over a heap.
#[divan::bench]
fn phold_in_a_bare_loop(bencher: Bencher) {
    bencher.counter(ItemsCount::new(EVENTS)).bench(|| {
        let random = Random(Cell::new(1996));
        let mut heap = BinaryHeap::new();
        let mut taken = [0_u64; ENTITIES];
        let (mut now, mut sent) = (Time::ZERO, 0);
        let mut send = |heap: &mut BinaryHeap<_>, now| {
            let (to, delay) = random.event();
            heap.push(Reverse((now + delay, sent, to)));
            sent += 1;
            sent < EVENTS
        };
        for _ in 0..ENTITIES {
            send(&mut heap, now);
        }
        let mut more = true;
        while let Some(Reverse((time, _, to))) = heap.pop() {
            now = time;
            taken[to] += 1;
            if more {
                more = send(&mut heap, now);
            }
        }
        (now, taken)
    });
}
