//! Running machines: times compared with closed formulas, order of messages, accounts, a golden trace.

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Simulation, Time};
use multicomputer::{Machine, MachineError, Multicomputer, NetworkModel, NodeAccount};
use proptest::prelude::*;
use serde_json::{Value, json};

const O_SEND: Duration = Duration(3_000_000);
const LATENCY: Duration = Duration(5_000_000);
const O_RECEIVE: Duration = Duration(2_000_000);
const GAP: Duration = Duration(1_000_000);
const HOP: Duration = Duration(40_000);

/// G × bytes at 100 MB/s: 10 ns a byte.
fn injection(bytes: u64) -> Duration {
    Duration(10_000) * bytes
}

/// Six compute nodes and a service node on a mesh of 3 × 3:
///
/// ```text
/// 0 1 2
/// 3 4 5
/// s - -
/// ```
fn machine() -> Machine {
    let sourced =
        |value: Value| json!({ "value": value, "provenance": "assumed", "source": "a test" });
    let file = json!({
        "title": "test machine",
        "mesh": {
            "width": sourced(json!(3)),
            "height": sourced(json!(3)),
            "hop_time": sourced(json!("40 ns")),
        },
        "compute_nodes": sourced(json!(6)),
        "service_nodes": sourced(json!(1)),
        "processor": {
            "clock": sourced(json!("50 MHz")),
            "scale": sourced(json!(1)),
            "operations": {},
        },
        "network": {
            "model": "loggp",
            "parameters": {
                "send_overhead": sourced(json!("3 us")),
                "latency": sourced(json!("5 us")),
                "receive_overhead": sourced(json!("2 us")),
                "gap": sourced(json!("1 us")),
                "bandwidth": sourced(json!("100 MB/s")),
            },
        },
    });
    Machine::from_json(&file.to_string(), "test.json").expect("the file is right")
}

fn multicomputer<M: 'static>(simulation: &Simulation, ranks: usize) -> Multicomputer<M> {
    Multicomputer::new(&simulation.handle(), &machine(), ranks).expect("there are that many nodes")
}

/// Time until a message of `bytes`, alone on the network, has been read `hops` links away.
fn one_way(bytes: u64, hops: u64) -> Duration {
    O_SEND + injection(bytes) + LATENCY + HOP * hops + O_RECEIVE
}

#[test]
fn ping_pong_takes_twice_the_formula() {
    // From rank 0 to rank 5 there are 3 hops; the service node, rank 6, stands 2 hops from 0.
    for (partner, hops) in [(1, 1), (5, 3), (6, 2)] {
        for bytes in [0, 1, 4_096] {
            let simulation = Simulation::new();
            let multicomputer = multicomputer::<&str>(&simulation, 6);
            let (left, right) = (multicomputer.node(0), multicomputer.node(partner));
            simulation.handle().spawn("left", async move {
                left.send(partner, bytes, "ping").await;
                left.wait().await;
                assert_eq!(left.received().await, ["pong"]);
            });
            simulation.handle().spawn("right", async move {
                right.wait().await;
                assert_eq!(right.received().await, ["ping"]);
                right.send(0, bytes, "pong").await;
            });
            let end = simulation.run().unwrap();
            assert_eq!(end, Time::ZERO + one_way(bytes, hops) * 2);
        }
    }
}

#[test]
fn an_exchange_takes_one_way_and_no_longer() {
    let simulation = Simulation::new();
    let multicomputer = multicomputer::<()>(&simulation, 2);
    for (rank, partner) in [(0, 1), (1, 0)] {
        let node = multicomputer.node(rank);
        simulation.handle().spawn(format!("node {rank}"), async move {
            node.send(partner, 4_096, ()).await;
            node.wait().await;
            node.received().await;
        });
    }
    assert_eq!(simulation.run().unwrap(), Time::ZERO + one_way(4_096, 1));
}

#[test]
fn the_port_injects_one_message_at_a_time() {
    let simulation = Simulation::new();
    let multicomputer = multicomputer::<u64>(&simulation, 2);
    let (sender, receiver) = (multicomputer.node(0), multicomputer.node(1));
    let messages = 5;
    simulation.handle().spawn("sender", async move {
        for number in 0..messages {
            sender.send(1, 4_096, number).await;
        }
        // The sender does not wait for its port.
        assert_eq!(sender.now(), Time::ZERO + O_SEND * messages);
    });
    simulation.handle().spawn("receiver", async move {
        for number in 0..messages {
            receiver.wait().await;
            let before = (injection(4_096) + GAP) * number + injection(4_096);
            assert_eq!(receiver.now(), Time::ZERO + O_SEND + before + LATENCY + HOP);
            assert_eq!(receiver.received().await, [number]);
        }
    });
    simulation.run().unwrap();
}

#[test]
fn received_reads_all_messages_and_charges_each() {
    let simulation = Simulation::new();
    let multicomputer = multicomputer::<usize>(&simulation, 3);
    for rank in [1, 2] {
        let node = multicomputer.node(rank);
        simulation.handle().spawn(format!("node {rank}"), async move {
            node.send(0, 0, node.rank()).await;
        });
    }
    let node = multicomputer.node(0);
    simulation.handle().spawn("node 0", async move {
        assert!(node.received().await.is_empty());
        assert_eq!(node.now(), Time::ZERO);
        node.compute(Duration::from_seconds_f64(1.0)).await;
        assert!(node.has_mail());
        node.wait().await;
        assert!(node.wait_until(Time::ZERO).await);
        assert_eq!(node.received().await, [1, 2]);
        assert_eq!(node.now(), Time::ZERO + Duration::from_seconds_f64(1.0) + O_RECEIVE * 2);
    });
    simulation.run().unwrap();
}

#[test]
fn waiting_ends_with_a_message_or_at_the_time_limit() {
    let simulation = Simulation::new();
    let multicomputer = multicomputer::<()>(&simulation, 2);
    let (sender, receiver) = (multicomputer.node(0), multicomputer.node(1));
    let arrival = Time::ZERO + O_SEND + LATENCY + HOP;
    simulation.handle().spawn("receiver", async move {
        let early = Time::ZERO + O_SEND;
        assert!(!receiver.wait_until(early).await);
        assert_eq!(receiver.now(), early);
        assert!(receiver.wait_until(Time::MAX).await);
        assert_eq!(receiver.now(), arrival);
    });
    simulation.handle().spawn("sender", async move { sender.send(1, 0, ()).await });
    assert_eq!(simulation.run().unwrap(), arrival);
}

#[test]
fn an_ideal_network_costs_nothing() {
    let simulation = Simulation::new();
    let mut ideal = machine();
    ideal.network_model = Some(NetworkModel::Ideal);
    let multicomputer = Multicomputer::<()>::new(&simulation.handle(), &ideal, 2).unwrap();
    let (sender, receiver) = (multicomputer.node(0), multicomputer.node(1));
    simulation.handle().spawn("sender", async move { sender.send(1, 1_000_000, ()).await });
    simulation.handle().spawn("receiver", async move {
        receiver.wait().await;
        receiver.received().await;
    });
    assert_eq!(simulation.run(), Ok(Time::ZERO));
}

#[test]
fn processes_must_fit_on_the_nodes() {
    let simulation = Simulation::new();
    let error = |ranks| match Multicomputer::<()>::new(&simulation.handle(), &machine(), ranks) {
        Ok(_) => panic!("expected an error"),
        Err(error) => error,
    };
    assert_eq!(error(0), MachineError::NoProcess);
    assert_eq!(error(0).to_string(), "found 0 compute processes; expected at least 1");
    assert_eq!(
        error(7).to_string(),
        "found 7 compute processes; expected at most 6, the compute nodes of the test machine"
    );
}

#[test]
fn a_stall_names_the_node() {
    let simulation = Simulation::new();
    let node = multicomputer::<()>(&simulation, 1).node(0);
    simulation.handle().spawn("compute node 0", async move { node.wait().await });
    assert_eq!(
        simulation.run().unwrap_err().to_string(),
        "stalled at 0 s: no event is left, but compute node 0 waits for mail at node 0"
    );
}

#[test]
fn accounts_divide_a_node_s_time_by_activity() {
    let simulation = Simulation::new();
    let multicomputer = multicomputer::<()>(&simulation, 2);
    let (sender, receiver) = (multicomputer.node(0), multicomputer.node(1));
    let work = Duration::from_seconds_f64(1e-3);
    simulation.handle().spawn("sender", async move {
        sender.compute(work).await;
        sender.send(1, 4_096, ()).await;
        sender.finish();
    });
    simulation.handle().spawn("receiver", async move {
        receiver.wait().await;
        receiver.received().await;
        receiver.compute(work).await;
    });
    let end = simulation.run().unwrap();
    let sender = NodeAccount {
        compute: work,
        send_overhead: O_SEND,
        messages_sent: 1,
        bytes_sent: 4_096,
        finished: Some(Time::ZERO + work + O_SEND),
        ..NodeAccount::default()
    };
    let receiver = NodeAccount {
        compute: work,
        receive_overhead: O_RECEIVE,
        idle: work + O_SEND + injection(4_096) + LATENCY + HOP,
        messages_received: 1,
        ..NodeAccount::default()
    };
    assert_eq!(receiver.life(), end - Time::ZERO);
    // The service node, rank 2, had no process.
    let service = NodeAccount { idle: end - Time::ZERO, ..NodeAccount::default() };
    assert_eq!(multicomputer.accounts(), [sender, receiver, service]);
}

#[test]
fn golden_trace_of_three_nodes() {
    let simulation = Simulation::new();
    let multicomputer = multicomputer::<String>(&simulation, 3);
    let trace = Rc::new(RefCell::new(String::new()));
    for rank in 0..3 {
        let (node, trace) = (multicomputer.node(rank), trace.clone());
        simulation.handle().spawn(format!("node {rank}"), async move {
            let note = |what: String| {
                trace
                    .borrow_mut()
                    .push_str(&format!("{:>9} {rank} {what}\n", node.now().to_string()));
            };
            node.compute(Duration(10_000_000) * (rank as u64 + 1)).await;
            for to in (0..3).filter(|&to| to != rank) {
                note(format!("sends to {to}"));
                node.send(to, 100, format!("{rank}→{to}")).await;
            }
            let mut taken = 0;
            while taken < 2 {
                node.wait().await;
                note("has mail".to_owned());
                let letters = node.received().await;
                note(format!("has read {}", letters.join(", ")));
                taken += letters.len();
            }
        });
    }
    simulation.run().unwrap();
    let golden = "
    10 µs 0 sends to 1
    13 µs 0 sends to 2
    20 µs 1 sends to 0
    23 µs 1 sends to 2
    26 µs 1 has mail
    28 µs 1 has read 0→1
 29.04 µs 0 has mail
    30 µs 2 sends to 0
 31.04 µs 0 has read 1→0
    33 µs 2 sends to 1
    36 µs 2 has mail
 39.08 µs 0 has mail
    40 µs 2 has read 0→2, 1→2
 41.08 µs 0 has read 2→0
 42.04 µs 1 has mail
 44.04 µs 1 has read 2→1
";
    assert_eq!(format!("\n{}", trace.borrow()), golden);
}

proptest! {
    /// Any traffic: order between each pair is kept, and every account sums to the elapsed time.
    #[test]
    fn order_is_kept_and_accounts_sum(
        letters in prop::collection::vec((0..7_usize, 0..7_usize, 0..10_000_u64, 0..50_u64), 0..60)
    ) {
        let simulation = Simulation::new();
        let multicomputer = multicomputer::<(usize, usize)>(&simulation, 6);
        let inboxes = Rc::new(RefCell::new(vec![Vec::new(); 7]));
        for rank in 0..7 {
            let mine: Vec<_> =
                letters.iter().copied().enumerate().filter(|(_, l)| l.0 == rank).collect();
            let expected = letters.iter().filter(|l| l.1 == rank).count();
            let (node, inboxes) = (multicomputer.node(rank), inboxes.clone());
            simulation.handle().spawn(format!("node {rank}"), async move {
                for (number, (_, to, bytes, work)) in mine {
                    node.compute(Duration(1_000_000) * work).await;
                    node.send(to, bytes, (rank, number)).await;
                }
                let mut taken = 0;
                while taken < expected {
                    node.wait().await;
                    let messages = node.received().await;
                    taken += messages.len();
                    inboxes.borrow_mut()[rank].extend(messages);
                }
            });
        }
        let end = simulation.run().unwrap();
        for inbox in inboxes.borrow().iter() {
            for from in 0..7 {
                let numbers = inbox.iter().filter(|m| m.0 == from).map(|m| m.1);
                prop_assert!(numbers.is_sorted());
            }
        }
        let accounts = multicomputer.accounts();
        for account in &accounts {
            prop_assert_eq!(account.life(), end - Time::ZERO);
        }
        let sent: u64 = accounts.iter().map(|account| account.messages_sent).sum();
        let received: u64 = accounts.iter().map(|account| account.messages_received).sum();
        prop_assert_eq!((sent, received), (letters.len() as u64, letters.len() as u64));
    }
}
