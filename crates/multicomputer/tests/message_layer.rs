//! The message layer: each mechanism alone, and what it costs senders and receivers.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::cell::RefCell;
use std::rc::Rc;

use desim::{Duration, Simulation, Stalled, Time};
use multicomputer::{Machine, Multicomputer, Node, NodeAccount, NodeMemory, Segment};
use serde_json::{Value, json};

const O: Duration = us(3);
const LATENCY: Duration = us(5);

const fn us(microseconds: u64) -> Duration {
    Duration(microseconds * 1_000_000)
}

/// 10 ns a byte.
fn injection(bytes: u64) -> Duration {
    Duration(10_000) * bytes
}

fn sourced(value: impl Into<Value>) -> Value {
    json!({ "value": value.into(), "provenance": "assumed", "source": "a test" })
}

/// Four nodes on a crossbar, overheads of 3 µs, a latency of 5 µs, 100 MB/s, and a message layer.
fn file(layer: &Value) -> Value {
    json!({
        "title": "test machine",
        "crossbar": { "hop_time": sourced("0 ns") },
        "compute_nodes": sourced(4),
        "service_nodes": sourced(1),
        "processor": { "clock": sourced("50 MHz"), "scale": sourced(1), "operations": {} },
        "network": {
            "model": "loggp",
            "parameters": {
                "send_overhead": sourced("3 us"),
                "latency": sourced("5 us"),
                "receive_overhead": sourced("3 us"),
                "gap": sourced("0 us"),
                "bandwidth": sourced("100 MB/s"),
            },
        },
        "message_layer": layer,
    })
}

fn machine(layer: &Value) -> Machine {
    Machine::from_json(&file(layer).to_string(), "m.json").unwrap()
}

/// A run of four nodes: its end, and their accounts.
struct Ran {
    end: Result<Time, Stalled>,
    nodes: Multicomputer<u32>,
}

impl Ran {
    fn end(&self) -> Duration {
        self.end.clone().unwrap() - Time::ZERO
    }

    fn account(&self, rank: usize) -> NodeAccount {
        self.nodes.accounts().swap_remove(rank)
    }
}

fn run<F: Future<Output = ()> + 'static>(layer: &Value, program: impl Fn(Node<u32>) -> F) -> Ran {
    run_on(&machine(layer), program)
}

fn run_on<F: Future<Output = ()> + 'static>(
    machine: &Machine,
    program: impl Fn(Node<u32>) -> F,
) -> Ran {
    let simulation = Simulation::new();
    let nodes = Multicomputer::new(&simulation.handle(), machine, 4).unwrap();
    for rank in 0..4 {
        simulation.handle().spawn(format!("process {rank}"), program(nodes.node(rank)));
    }
    Ran { end: simulation.run(), nodes }
}

/// Node 0 sends `count` messages of 1,000 bytes to node 1, which computes for `busy` and then reads
/// them all.
async fn letters(node: Node<u32>, count: u32, busy: Duration) {
    match node.rank() {
        0 => {
            for number in 0..count {
                node.send(1, 1_000, number).await;
            }
        }
        1 => {
            node.compute(busy).await;
            let mut read = Vec::new();
            while read.len() < count as usize {
                node.wait().await;
                read.extend(node.received().await);
            }
            assert!(read.is_sorted());
        }
        _ => {}
    }
}

/// Time of a message of 1,000 bytes without any mechanism.
fn plain() -> Duration {
    O + injection(1_000) + LATENCY + O
}

#[test]
fn without_a_message_layer_nothing_is_added() {
    let ran = run(&json!({}), |node| letters(node, 1, Duration::ZERO));
    assert_eq!(ran.end(), plain());
    let reader = ran.account(1);
    assert_eq!(reader.overhead(), O);
    assert_eq!((reader.layer.unposted_messages, reader.layer.buffer_bytes_most), (0, 0));
}

#[test]
fn packets_take_the_sender_time_each() {
    let layer = json!({ "packets": { "size": sourced("300 B"), "time": sourced("2 us") } });
    let ran = run(&layer, |node| letters(node, 1, Duration::ZERO));
    // Three full packets and one that is not.
    assert_eq!(ran.end(), us(2) * 4 + plain());
    assert_eq!((ran.account(0).layer.packing, ran.account(0).send_overhead), (us(2) * 4, O));
    assert_eq!(ran.account(1).overhead(), O);
    let empty = machine(&layer).message_layer.packing(0);
    assert_eq!(empty, us(2));
}

/// Three unread messages page a segment out: they are copied, it is paged in, and the account has both.
#[test]
fn a_node_pays_for_its_messages_and_its_memory() {
    let memory = NodeMemory {
        available: 10_000,
        message_buffers: 0,
        burst: 1_000,
        fault_time: us(7),
        bandwidth: 1e9,
        sizes: [].into(),
    };
    let layer = json!({ "copy_bandwidth": sourced("50 MB/s") });
    let mut machine = machine(&layer);
    machine.node_memory = Some(memory);
    let ran = run_on(&machine, |node| async move {
        node.keep(Segment(0), 8_000);
        letters(node.clone(), 3, us(100)).await;
        node.touch([Segment(0)]).await;
        node.finish();
    });
    let account = ran.account(1);
    assert_eq!((account.compute, account.receive_overhead), (us(100), O * 3));
    assert_eq!((account.layer.copying, account.paging), (us(20) * 3, us(7 + 1) * 8));
    assert_eq!(account.memory_high_water, Some(11_000));
    assert_eq!((account.life(), account.idle), (ran.end(), Duration::ZERO));
}

#[test]
fn a_message_without_a_posted_receive_is_copied() {
    let layer = json!({ "copy_bandwidth": sourced("50 MB/s") });
    // Waited for: no copy.
    let ran = run(&layer, |node| letters(node, 1, Duration::ZERO));
    assert_eq!((ran.end(), ran.account(1).layer.copying), (plain(), Duration::ZERO));
    // Busy when it comes: 20 ns a byte.
    let ran = run(&layer, |node| letters(node, 1, us(100)));
    assert_eq!(ran.end(), us(100) + O + us(20));
    let reader = ran.account(1);
    assert_eq!((reader.layer.copying, reader.layer.unposted_messages), (us(20), 1));
    assert_eq!(reader.life(), ran.end());
    // Three messages, 10 µs apart: the first is waited for, the second comes after its reading, the
    // third as well.
    let ran = run(&layer, |node| letters(node, 3, Duration::ZERO));
    assert_eq!(ran.account(1).layer.unposted_messages, 0);
}

#[test]
fn a_wait_that_has_timed_out_posts_no_receive() {
    let layer = json!({ "copy_bandwidth": sourced("50 MB/s") });
    let ran = run(&layer, |node| async move {
        if node.rank() == 1 {
            assert!(!node.wait_until(Time::ZERO + us(1)).await);
        }
        letters(node, 1, us(100)).await;
    });
    assert_eq!(ran.account(1).layer.unposted_messages, 1);
}

#[test]
fn a_coprocessor_overlaps_the_overheads_with_computation() {
    let busy = |node: Node<u32>| async move {
        if node.rank() == 0 {
            node.send(1, 1_000, 0).await;
            node.compute(us(100)).await;
        } else {
            letters(node, 1, us(100)).await;
        }
    };
    let without = run(&json!({}), busy);
    assert_eq!(without.account(0).life() - without.account(0).idle, O + us(100));
    assert_eq!(without.end(), us(100) + O);
    let layer = json!({ "coprocessor": { "handover": sourced("1 us") } });
    let with = run(&layer, busy);
    let (sender, reader) = (with.account(0), with.account(1));
    // Both are busy with the message for as long as it is handed over, and no longer.
    assert_eq!((sender.send_overhead, sender.layer.coprocessor), (us(1), O));
    assert_eq!((reader.receive_overhead, reader.layer.coprocessor), (us(1), O));
    assert_eq!(with.end(), us(101));
    // Nothing to overlap with: the message takes longer.
    let ran = run(&layer, |node| letters(node, 1, Duration::ZERO));
    assert_eq!(ran.end(), us(1) + plain() + us(1));
}

#[test]
fn a_coprocessor_does_one_thing_at_a_time() {
    let layer = json!({
        "coprocessor": { "handover": sourced("1 us") },
        "packets": { "size": sourced("300 B"), "time": sourced("2 us") },
    });
    let ran = run(&layer, |node| letters(node, 3, Duration::ZERO));
    let each = us(2) * 4 + O;
    assert_eq!(ran.account(0).layer.coprocessor, each * 3);
    assert_eq!(
        (ran.account(0).send_overhead, ran.account(0).layer.packing),
        (us(3), Duration::ZERO)
    );
    // Three times from the first handover on; the last message's way; what its reader does.
    assert_eq!(ran.end(), us(1) + each * 3 + injection(1_000) + LATENCY + O + us(1));
}

#[test]
fn a_sender_waits_while_the_buffers_are_full() {
    let layer = json!({ "buffers": sourced("2 KB") });
    let ran = run(&layer, |node| letters(node, 3, us(100)));
    let (sender, reader) = (ran.account(0), ran.account(1));
    // Two messages fill the buffers; the third leaves when they have been read.
    assert_eq!(sender.layer.waiting_for_room, us(100) + O * 2 - O * 2);
    assert_eq!((sender.layer.held_messages, reader.layer.buffer_bytes_most), (1, 2_000));
    assert_eq!(ran.end(), us(100) + O * 2 + plain());
    // The coprocessor's messages wait without it, and so does the processor.
    let layer = json!({
        "buffers": sourced("2 KB"),
        "coprocessor": { "handover": sourced("1 us") },
    });
    let ran = run(&layer, |node| letters(node, 3, us(100)));
    let sender = ran.account(0);
    assert_eq!((sender.layer.waiting_for_room, sender.layer.held_messages), (Duration::ZERO, 1));
    assert_eq!(ran.end(), us(100) + us(2) + plain() + us(1));
}

#[test]
fn a_message_longer_than_the_buffers_waits_until_they_are_empty() {
    let layer = json!({ "buffers": sourced("10 B") });
    let ran = run(&layer, |node| letters(node, 2, us(100)));
    assert_eq!(ran.account(0).layer.held_messages, 1);
    assert_eq!(ran.account(1).layer.buffer_bytes_most, 1_000);
}

#[test]
fn a_process_that_has_finished_blocks_no_sender() {
    let layer = json!({ "buffers": sourced("10 B") });
    let ran = run(&layer, |node| async move {
        match node.rank() {
            0 => letters(node, 5, Duration::ZERO).await,
            1 => {
                node.compute(us(50)).await;
                node.finish();
            }
            _ => {}
        }
    });
    assert_eq!(ran.account(0).layer.waiting_for_room, us(50) - O);
}

/// Each of the first `count` nodes sends two messages to the next before it reads any.
async fn ring(node: Node<u32>, count: usize) {
    if node.rank() < count {
        for number in 0..2 {
            node.send((node.rank() + 1) % count, 1_000, number).await;
        }
        let mut read = 0;
        while read < 2 {
            node.wait().await;
            read += node.received().await.len();
        }
    }
}

#[test]
fn a_deadlock_by_full_buffers_names_its_processes() {
    let ran = run(&json!({ "buffers": sourced("1.5 KB") }), |node| ring(node, 3));
    let full = ran.nodes.full_buffers().unwrap();
    assert_eq!(full.circle, [2, 0, 1]);
    let stalled = ran.end.unwrap_err();
    assert_eq!(
        stalled.cause.unwrap(),
        "deadlock by full buffers: each of the nodes 2, 0, 1 waits for room in those of the next, \
         and the last in those of the first"
    );
    let own = run(&json!({ "buffers": sourced("1.5 KB") }), |node| ring(node, 1));
    assert_eq!(own.nodes.full_buffers().unwrap().circle, [0]);
    // Room for two, or a coprocessor that waits in the processor's stead.
    assert!(run(&json!({ "buffers": sourced("2 KB") }), |node| ring(node, 3)).end.is_ok());
    let layer = json!({
        "buffers": sourced("1.5 KB"),
        "coprocessor": { "handover": sourced("0 us") },
    });
    assert!(run(&layer, |node| ring(node, 3)).end.is_ok());
}

#[test]
fn a_stall_names_the_buffers_without_room() {
    let ran = run(&json!({ "buffers": sourced("1 KB") }), |node| async move {
        if node.rank() == 0 {
            letters(node, 2, Duration::ZERO).await;
        }
    });
    assert_eq!(ran.nodes.full_buffers(), None);
    let text = ran.end.unwrap_err().to_string();
    assert!(text.ends_with("but process 0 waits for room in the buffers of node 1"), "{text}");
}

#[test]
fn all_mechanisms_together_lose_no_time_and_no_message() {
    let layer = json!({
        "packets": { "size": sourced("300 B"), "time": sourced("2 us") },
        "copy_bandwidth": sourced("50 MB/s"),
        "buffers": sourced("5 KB"),
    });
    let received = Rc::new(RefCell::new(vec![Vec::new(); 4]));
    let ran = run(&layer, |node| {
        let received = Rc::clone(&received);
        async move {
            let rank = node.rank();
            let mut mine = Vec::new();
            for round in 0..20_u32 {
                node.compute(us(7 * (rank as u64 + 1))).await;
                node.send((rank + 1) % 4, 1_000, round).await;
                mine.extend(node.received().await);
            }
            while mine.len() < 20 {
                node.wait().await;
                mine.extend(node.received().await);
            }
            received.borrow_mut()[rank] = mine;
        }
    });
    let end = ran.end();
    for (rank, mine) in received.borrow().iter().enumerate() {
        assert_eq!(mine, &(0..20).collect::<Vec<_>>());
        assert_eq!(ran.account(rank).life(), end);
    }
    assert!((0..4).any(|rank| ran.account(rank).layer.copying > Duration::ZERO));
}

#[test]
fn sizes_are_whole_numbers_of_bytes() {
    for (layer, expected) in [
        (json!({ "buffers": sourced("0 B") }), "buffers.value: found 0 B"),
        (
            json!({ "packets": { "size": sourced("1.5 B"), "time": sourced("1 us") } }),
            "packets.size.value: found 1.5 B",
        ),
    ] {
        let error = Machine::from_json(&file(&layer).to_string(), "m.json").unwrap_err();
        assert_eq!(
            error.to_string(),
            format!(
                "m.json:1: message_layer.{expected}; expected a whole number of bytes, at least 1"
            )
        );
    }
}
