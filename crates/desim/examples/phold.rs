//! PHOLD, the usual benchmark of event engines: every event schedules one more, for a random entity, after
//! a random time. `phold EVENTS [engine|processes|bare]` prints the last virtual time, which is the
//! same for all; time it from outside.

use std::cell::RefCell;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::rc::Rc;

use desim::{Duration, Handle, Simulation, Time};

/// Entities, and pending events at any time.
const ENTITIES: u64 = 56;

/// The random state of every entity, and the events left.
struct Phold {
    random: Vec<u64>,
    left: u64,
}

impl Phold {
    fn new(events: u64) -> Phold {
        Phold { random: (1..=ENTITIES).collect(), left: events }
    }

    /// The event that follows one at an entity: its entity, and the ticks until then.
    fn next(&mut self, entity: u64) -> Option<(u64, u64)> {
        self.left = self.left.checked_sub(1)?;
        let state = &mut self.random[entity as usize];
        // xorshift64: any cheap generator is good enough.
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        Some((*state % ENTITIES, 1 + (*state >> 40)))
    }
}

fn happen(phold: &Rc<RefCell<Phold>>, handle: &Handle, entity: u64) {
    let Some((to, after)) = phold.borrow_mut().next(entity) else { return };
    let (phold, same) = (Rc::clone(phold), handle.clone());
    handle.at(handle.now() + Duration(after), move || happen(&phold, &same, to));
}

/// By callbacks.
fn engine(events: u64) -> Time {
    let simulation = Simulation::new();
    let (phold, handle) = (Rc::new(RefCell::new(Phold::new(events))), simulation.handle());
    (0..ENTITIES).for_each(|entity| happen(&phold, &handle, entity));
    simulation.run().unwrap_or_default()
}

/// By processes, each of which follows one event from entity to entity.
fn processes(events: u64) -> Time {
    let simulation = Simulation::new();
    let (phold, handle) = (Rc::new(RefCell::new(Phold::new(events))), simulation.handle());
    for start in 0..ENTITIES {
        let (phold, handle, mut entity) = (Rc::clone(&phold), handle.clone(), start);
        simulation.handle().spawn(format!("event {start}"), async move {
            loop {
                let Some((to, after)) = phold.borrow_mut().next(entity) else { return };
                handle.sleep(Duration(after)).await;
                entity = to;
            }
        });
    }
    simulation.run().unwrap_or_default()
}

/// A heap and nothing else.
fn bare(events: u64) -> Time {
    let (mut phold, mut heap, mut number) = (Phold::new(events), BinaryHeap::new(), 0_u64);
    let mut last = 0;
    for entity in 0..ENTITIES {
        heap.push(Reverse((0, entity, entity)));
    }
    while let Some(Reverse((now, _, entity))) = heap.pop() {
        last = now;
        if let Some((to, after)) = phold.next(entity) {
            number += 1;
            heap.push(Reverse((now + after, ENTITIES + number, to)));
        }
    }
    Time(last)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let events = arguments.first().and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let last = match arguments.get(1).map_or("engine", String::as_str) {
        "bare" => bare(events),
        "processes" => processes(events),
        _ => engine(events),
    };
    println!("{last}");
}
