//! Reading of one file through the I/O nodes: contention compared with its closed form.

use std::collections::BTreeMap;

use desim::{Duration, Time};
use multicomputer::{Reading, StartUp};

/// 10 µs and a microsecond a byte, 1,000 bytes at a time.
fn disks(io_nodes: usize) -> StartUp {
    StartUp {
        io_nodes,
        bandwidth: 1e6,
        access_time: Duration(10_000_000),
        request: 1_000,
        cycles: BTreeMap::new(),
    }
}

/// When the last node has read the file.
fn last(readings: &[Reading]) -> Duration {
    readings.iter().map(|reading| reading.done - Time::ZERO).max().unwrap_or_default()
}

#[test]
fn n_nodes_take_n_times_as_long_through_one_io_node() {
    for requests in [1, 2, 7] {
        let alone = disks(1).service(1_000) * requests;
        for nodes in [1, 2, 5, 56] {
            let readings = disks(1).read(nodes, requests * 1_000);
            assert_eq!(last(&readings), alone * nodes as u64);
            let waits = readings.iter().map(|reading| reading.waited);
            assert_eq!(waits.max(), Some(alone * (nodes as u64 - 1)));
            // Who has read what he reads has spent his time at the disks or waiting for them.
            assert!(readings.iter().all(|r| r.done - Time::ZERO == alone + r.waited));
        }
    }
}

/// Except for the first requests, all of which go to the first I/O node.
#[test]
fn k_io_nodes_divide_it() {
    for io_nodes in [2, 3, 4] {
        for (nodes, turns) in [(8, 1), (8, 5), (56, 3)] {
            let requests = turns * io_nodes as u64;
            let readings = disks(io_nodes).read(nodes, requests * 1_000);
            let divided = nodes as u64 * requests / io_nodes as u64 + io_nodes as u64 - 1;
            assert_eq!(last(&readings), disks(1).service(1_000) * divided);
        }
        // A node alone asks for one thing after the other, wherever it lies.
        let alone = disks(io_nodes).read(1, 5_000);
        assert_eq!((last(&alone), alone[0].waited), (disks(1).service(1_000) * 5, Duration::ZERO));
    }
}

#[test]
fn the_last_request_is_shorter() {
    let service = |bytes| disks(1).service(bytes);
    assert_eq!(last(&disks(3).read(1, 1_001)), service(1_000) + service(1));
    assert_eq!(last(&disks(1).read(2, 1)), service(1) * 2);
    assert_eq!(disks(2).read(2, 0), vec![Reading::default(); 2]);
    assert_eq!(disks(2).read(0, 1), vec![]);
}
