//! Processes, signals and time through the public interface: each test is a small program with its exact
//! expected trace.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use desim::{Alarm, Duration, Handle, Signal, Simulation, Stalled, Time, Waiting};

/// Lines stamped with virtual time.
#[derive(Clone)]
struct Log {
    handle: Handle,
    text: Rc<RefCell<String>>,
}

impl Log {
    fn new(handle: &Handle) -> Log {
        Log { handle: handle.clone(), text: Rc::default() }
    }

    fn line(&self, line: impl AsRef<str>) {
        let now = self.handle.now();
        self.text.borrow_mut().push_str(&format!("{now:>8}  {}\n", line.as_ref()));
    }

    fn expect(&self, lines: &[&str]) {
        assert_eq!(self.text.borrow().lines().collect::<Vec<_>>(), lines);
    }
}

fn ns(count: u64) -> Duration {
    Duration(1_000) * count
}

fn at_ns(count: u64) -> Time {
    Time::ZERO + ns(count)
}

#[test]
fn equal_times_are_first_come_first_served() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let log = Log::new(&handle);
    for name in ["second", "third"] {
        let log = log.clone();
        handle.at(at_ns(5), move || log.line(name));
    }
    let (later, h) = (log.clone(), handle.clone());
    handle.at(at_ns(1), move || {
        later.line("first");
        let log = later.clone();
        h.at(at_ns(5), move || log.line("fourth"));
        let log = later.clone();
        h.at(Time::ZERO, move || log.line("a past time is the present"));
        later.line("after the calls to at");
    });
    assert_eq!(simulation.run(), Ok(at_ns(5)));
    log.expect(&[
        "    1 ns  first",
        "    1 ns  after the calls to at",
        "    1 ns  a past time is the present",
        "    5 ns  second",
        "    5 ns  third",
        "    5 ns  fourth",
    ]);
}

#[test]
fn ping_pong() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let log = Log::new(&handle);
    let (ping, pong) = (Signal::new(&handle, "ping"), Signal::new(&handle, "pong"));

    let (h, l, hear, call) = (handle.clone(), log.clone(), ping.clone(), pong.clone());
    handle.spawn("right", async move {
        for _ in 0..2 {
            hear.wait().await;
            h.sleep(ns(3)).await;
            l.line("pong");
            call.notify();
        }
    });
    let (h, l) = (handle.clone(), log.clone());
    handle.spawn("left", async move {
        for _ in 0..2 {
            h.sleep(ns(10)).await;
            l.line("ping");
            ping.notify();
            pong.wait().await;
        }
    });
    assert_eq!(simulation.run(), Ok(at_ns(26)));
    log.expect(&["   10 ns  ping", "   13 ns  pong", "   23 ns  ping", "   26 ns  pong"]);
}

/// A process waits for a signal until 10 ns; the signal is notified at `notified`. With `signal_first`
/// the notification is scheduled before the process starts.
fn race(notified: Time, signal_first: bool) -> (Option<bool>, Time) {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let signal = Signal::new(&handle, "signal");
    let outcome = Rc::new(Cell::new(None));

    let notifier = signal.clone();
    let (h, result) = (handle.clone(), outcome.clone());
    let process = async move {
        result.set(Some(signal.wait_until(at_ns(10)).await));
        assert_eq!(h.now(), notified.min(at_ns(10)));
    };
    if signal_first {
        handle.at(notified, move || notifier.notify());
        handle.spawn("waiter", process);
    } else {
        handle.spawn("waiter", process);
        let h = handle.clone();
        // Scheduled when the waiter's own timer is already in the queue.
        handle.at(at_ns(1), move || h.at(notified, move || notifier.notify()));
    }
    let end = simulation.run().expect("no process waits forever");
    (outcome.get(), end)
}

#[test]
fn signal_and_time_race() {
    // The stale timer does not keep the simulation alive until 10 ns.
    assert_eq!(race(at_ns(4), true), (Some(true), at_ns(4)));
    assert_eq!(race(at_ns(4), false), (Some(true), at_ns(4)));
    // At equal times the order of scheduling decides.
    assert_eq!(race(at_ns(10), true), (Some(true), at_ns(10)));
    assert_eq!(race(at_ns(10), false), (Some(false), at_ns(10)));
    // A notification after the time limit reaches no process and has no effect.
    assert_eq!(race(at_ns(40), true), (Some(false), at_ns(40)));
}

#[test]
fn a_signal_has_no_memory_and_wakes_in_order_of_arrival() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let log = Log::new(&handle);
    let signal = Signal::new(&handle, "signal");
    signal.notify();
    for (name, arrives) in [("late", 3), ("early", 1), ("middle", 2)] {
        let (h, l, signal) = (handle.clone(), log.clone(), signal.clone());
        handle.spawn(name, async move {
            h.sleep(ns(arrives)).await;
            signal.wait().await;
            l.line(name);
        });
    }
    handle.at(at_ns(5), move || signal.notify());
    assert_eq!(simulation.run(), Ok(at_ns(5)));
    log.expect(&["    5 ns  early", "    5 ns  middle", "    5 ns  late"]);
}

#[test]
fn a_dropped_wait_is_harmless() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let (signal, h) = (Signal::new(&handle, "signal"), handle.clone());
    handle.spawn("impatient", async move {
        // Polls a wait once, then drops it.
        let mut wait = Box::pin(signal.wait_until(at_ns(1_000)));
        std::future::poll_fn(|context| {
            assert!(wait.as_mut().poll(context).is_pending());
            std::task::Poll::Ready(())
        })
        .await;
        drop(wait);
        signal.notify();
        h.sleep(ns(7)).await;
        assert_eq!(h.now(), at_ns(7));
    });
    assert_eq!(simulation.run(), Ok(at_ns(7)));
}

#[test]
fn a_stall_names_the_waiting_processes_and_what_they_wait_for() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    for (name, object) in [("node 0", "mail at node 0"), ("node 1", "mail at node 1")] {
        let (h, mail) = (handle.clone(), Signal::new(&handle, object));
        handle.spawn(name, async move {
            h.sleep(ns(2)).await;
            mail.wait().await;
        });
    }
    handle.spawn("done", async {});
    handle.spawn("foreign future", std::future::pending());
    let stalled = simulation.run().unwrap_err();
    let waiting = |process: &str, on: &str| Waiting { process: process.into(), on: on.into() };
    assert_eq!(
        stalled,
        Stalled {
            at: at_ns(2),
            cause: None,
            waiting: vec![
                waiting("node 0", "mail at node 0"),
                waiting("node 1", "mail at node 1"),
                waiting("foreign future", "a future that no event resolves"),
            ],
        }
    );
    assert_eq!(
        stalled.to_string(),
        "stalled at 2 ns: no event is left, but node 0 waits for mail at node 0; \
         node 1 waits for mail at node 1; foreign future waits for a future that no event resolves"
    );
}

#[test]
fn a_run_can_go_on_after_a_stall() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let signal = Signal::new(&handle, "signal");
    let waiting = signal.clone();
    handle.spawn("waiter", async move { waiting.wait().await });
    assert!(simulation.run().is_err());
    signal.notify();
    assert_eq!(simulation.run(), Ok(Time::ZERO));
}

#[test]
fn a_hundred_thousand_events() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let steps = Rc::new(Cell::new(0_u64));
    for process in 1..=100_u64 {
        let (h, steps) = (handle.clone(), steps.clone());
        handle.spawn(format!("process {process}"), async move {
            for _ in 0..1_000 {
                h.sleep(Duration(process)).await;
                steps.set(steps.get() + 1);
            }
        });
    }
    assert_eq!(simulation.run(), Ok(Time(100_000)));
    assert_eq!(steps.get(), 100_000);
}

#[test]
fn a_dropped_simulation_frees_its_processes() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let held = Rc::new(());
    let (signal, in_process) = (Signal::new(&handle, "signal"), held.clone());
    handle.spawn("waits forever", async move {
        signal.wait().await;
        drop(in_process);
    });
    assert!(simulation.run().is_err());
    assert_eq!(Rc::strong_count(&held), 2);
    drop(simulation);
    assert_eq!(Rc::strong_count(&held), 1);
}

#[test]
fn an_alarm_goes_off_at_the_earliest_time_set() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let log = Log::new(&handle);
    let lines = log.clone();
    let alarm = Alarm::new(&handle, move || lines.line("goes off"));
    alarm.set(at_ns(9));
    alarm.set(at_ns(4));
    alarm.set(at_ns(6));
    let same = alarm.clone();
    handle.at(at_ns(5), move || same.set(at_ns(7)));
    // The stale event for 9 ns does not keep the simulation alive.
    assert_eq!(simulation.run(), Ok(at_ns(7)));
    log.expect(&["    4 ns  goes off", "    7 ns  goes off"]);
}

#[test]
fn a_halt_ends_the_run_with_its_cause() {
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let (h, signal) = (handle.clone(), Signal::new(&handle, "signal"));
    handle.spawn("waiter", async move { signal.wait().await });
    handle.at(at_ns(1), move || h.halt("broken signal"));
    handle.at(at_ns(2), || panic!("the run goes on"));
    assert_eq!(
        simulation.run().unwrap_err().to_string(),
        "stalled at 1 ns: broken signal, but waiter waits for signal"
    );
}
