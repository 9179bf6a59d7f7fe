//! The connection to a display: each part compared with its closed form, and overload.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::rc::Rc;

use desim::{Duration, Simulation, Time};
use multicomputer::{
    Display, DisplayAccount, Ethernet, Machine, Multicomputer, NodeAccount, Socket, WhenFull,
};
use serde_json::{Value, json};

const NODES: usize = 4;

const fn us(microseconds: u64) -> Duration {
    Duration(microseconds * 1_000_000)
}

/// A microsecond a byte in frames of 1,000 bytes with 100 more, made in 10 µs and 0.1 µs a byte; a
/// display that takes 50 µs. There is room for everything.
fn display() -> Display {
    Display {
        frame_time: us(10),
        copy_bandwidth: 1e7,
        service_buffers: 1_000_000,
        when_full: WhenFull::BackPressure,
        ethernet: Ethernet { bandwidth: 1e6, payload: 1_000, overhead: 100 },
        window: 1_000_000,
        update_time: us(50),
    }
}

/// A crossbar without overheads: a byte takes 10 ns.
fn machine(display: Display) -> Machine {
    let sourced = |value: Value| json!({ "value": value, "provenance": "assumed", "source": "t" });
    let zero = || sourced(json!("0 us"));
    let file = json!({
        "title": "test machine",
        "crossbar": { "hop_time": zero() },
        "compute_nodes": sourced(json!(NODES)),
        "service_nodes": sourced(json!(1)),
        "processor": {
            "clock": sourced(json!("50 MHz")), "scale": sourced(json!(1)), "operations": {},
        },
        "network": {
            "model": "loggp",
            "parameters": {
                "send_overhead": zero(), "latency": zero(), "receive_overhead": zero(), "gap": zero(),
                "bandwidth": sourced(json!("100 MB/s")),
            },
        },
    });
    let mut machine = Machine::from_json(&file.to_string(), "m.json").unwrap();
    machine.display = Some(display);
    machine
}

/// The service node queues these updates at time zero and sends them.
fn send(display: &Display, updates: &[u64]) -> (DisplayAccount, NodeAccount) {
    let simulation = Simulation::new();
    let nodes =
        Multicomputer::<u64>::new(&simulation.handle(), &machine(display.clone()), 1).unwrap();
    let socket = Rc::new(Socket::new(display, nodes.node(1)));
    updates.iter().for_each(|&bytes| socket.queue(bytes));
    let (sending, node) = (Rc::clone(&socket), nodes.node(1));
    simulation.handle().spawn("service node", async move {
        while sending.send().await {}
        node.finish();
    });
    simulation.run().unwrap();
    (socket.account(), nodes.accounts().swap_remove(1))
}

/// If only the Ethernet is slow, its frames follow each other without a gap, at the rate of the formula.
#[test]
fn the_slowest_part_decides_the_throughput() {
    let [fast, slow] = [us(1), us(5_000)];
    for (frame_time, update_time, bytes, slowest) in [
        (us(10), us(50), 700, us(800)),
        (us(10), us(50), 2_500, us(2_800)),
        (slow, fast, 1_000, us(5_100)),
        (fast, slow, 1_000, us(5_000)),
    ] {
        let display = Display { frame_time, update_time, ..display() };
        let wire = display.ethernet.time(bytes);
        let once = display.forwarding(bytes) + wire + update_time;
        let (account, service) = send(&display, &[bytes; 100]);
        let end = account.last_shown - Time::ZERO;
        assert_eq!(end, once + slowest * 99);
        assert!((display.rate(bytes) * slowest.as_seconds_f64() - 1.0).abs() < 1e-12);
        assert_eq!((account.shown, account.shown_bytes, account.dropped), (100, 100 * bytes, 0));
        assert_eq!(account.ethernet_busy, wire * 100);
        assert_eq!(account.consumer_busy, update_time * 100);
        assert_eq!(service.forwarding, display.forwarding(bytes) * 100);
        assert_eq!(service.waiting_for_display, Duration::ZERO);
    }
}

/// With a window of one update, the next one is sent when the display has taken it.
#[test]
fn a_full_window_blocks_the_service_node() {
    let display = Display { window: 1_000, ..display() };
    let (account, service) = send(&display, &[1_000; 10]);
    let (made, turn) = (us(110), us(1_100 + 50));
    assert_eq!(account.last_shown - Time::ZERO, made + turn * 10);
    assert_eq!(service.waiting_for_display, (turn - made) * 9);
    assert_eq!(service.life(), made + turn * 9);
    // An update that is longer than the window has it to itself.
    let (account, _) = send(&Display { window: 1, ..display }, &[1_000; 10]);
    assert_eq!(account.last_shown - Time::ZERO, made + turn * 10);
}

#[test]
fn updates_without_room_are_dropped_or_replace_the_oldest() {
    let updates = [100, 200, 300, 400];
    for (when_full, shown, shown_bytes) in [
        (WhenFull::BackPressure, 4, 1_000),
        (WhenFull::DropNewest, 2, 300),
        (WhenFull::DropOldest, 1, 400),
    ] {
        let (account, _) =
            send(&Display { service_buffers: 500, when_full, ..display() }, &updates);
        assert_eq!((account.shown, account.shown_bytes), (shown, shown_bytes), "{when_full:?}");
        assert_eq!(account.dropped, 4 - shown);
    }
    // One that is longer than all room has it to itself.
    for when_full in [WhenFull::DropNewest, WhenFull::DropOldest] {
        let (account, _) = send(&Display { service_buffers: 1, when_full, ..display() }, &[100]);
        assert_eq!((account.shown, account.dropped), (1, 0));
    }
}

/// Every compute node sends 50 updates of 1,000 bytes, far more than the service node can forward.
fn overload(display: &Display) -> (DisplayAccount, Vec<NodeAccount>) {
    const EACH: u64 = 50;
    let simulation = Simulation::new();
    let handle = simulation.handle();
    let machine = machine(display.clone());
    let nodes = Multicomputer::<u64>::new(&handle, &machine, NODES).unwrap();
    for rank in 0..NODES {
        let node = nodes.node(rank);
        handle.spawn(format!("compute node {rank}"), async move {
            for _ in 0..EACH {
                node.compute(us(10)).await;
                node.send(NODES, 1_000, 1_000).await;
            }
            node.finish();
        });
    }
    let node = nodes.node(NODES);
    let socket = Rc::new(Socket::new(display, node.clone()));
    let sending = Rc::clone(&socket);
    handle.spawn("service node", async move {
        let mut read = 0;
        while read < EACH * NODES as u64 {
            node.wait().await;
            loop {
                if sending.wants_more() {
                    for bytes in node.received().await {
                        sending.queue(bytes);
                        read += 1;
                    }
                }
                if !sending.send().await {
                    break;
                }
            }
        }
        node.finish();
    });
    simulation.run().unwrap();
    (socket.account(), nodes.accounts())
}

/// The Ethernet takes 1.1 ms an update, compute nodes make one every 2.5 µs.
#[test]
fn compute_nodes_wait_under_back_pressure() {
    let drowned = Display { service_buffers: 5_000, window: 2_000, ..display() };
    let (account, accounts) = overload(&drowned);
    assert_eq!((account.shown, account.dropped), (200, 0));
    // The Ethernet is never idle, but for the first update and while the display takes the last.
    let end = account.last_shown - Time::ZERO;
    assert_eq!(account.ethernet_busy, us(1_100) * 200);
    assert!(end - account.ethernet_busy < us(200), "{end}");
    for account in &accounts[..NODES] {
        // Each node sends a quarter of the updates. No node waits for the last ones.
        let waited = account.waiting_for_display.as_seconds_f64() / end.as_seconds_f64();
        assert!((0.9..1.0).contains(&waited), "{waited}");
        assert_eq!(account.layer.waiting_for_room, Duration::ZERO);
        let finished = account.finished.unwrap() - Time::ZERO;
        assert_eq!(account.life(), finished);
    }

    let (account, accounts) = overload(&display());
    assert_eq!(account.shown, 200);
    assert!(accounts[..NODES].iter().all(|node| node.waiting_for_display == Duration::ZERO));
}

#[test]
fn compute_nodes_do_not_wait_if_updates_are_dropped() {
    for when_full in [WhenFull::DropOldest, WhenFull::DropNewest] {
        let drowned = Display { service_buffers: 5_000, window: 2_000, when_full, ..display() };
        let (account, accounts) = overload(&drowned);
        assert_eq!(account.shown + account.dropped, 200);
        assert!(account.dropped > 150, "{}", account.dropped);
        for node in &accounts[..NODES] {
            assert_eq!(node.waiting_for_display, Duration::ZERO);
            assert_eq!(node.life(), us(10) * 50);
        }
    }
}
