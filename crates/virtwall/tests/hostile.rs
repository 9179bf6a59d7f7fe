//! Random machines and rules: every run ends, with all its energy, or says why it cannot.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{paragon, rules, two_rooms_cut};
use desim::Duration;
use multicomputer::{
    LinkParameters, LogGpParameters, Machine, MessageLayer, NetworkModel, Packets,
};
use proptest::prelude::*;
use virtwall::{
    Ending, KeptShots, Mapping, Order, Rules, Run, RunError, Selection, Shooting, SourceSplit,
    Ties, simulate,
};

/// Seconds from nothing to far more than a shot takes.
fn seconds() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), (-8.0..2.0).prop_map(|power| 10.0_f64.powf(power))]
}

fn duration() -> impl Strategy<Value = Duration> {
    seconds().prop_map(Duration::from_seconds_f64)
}

/// Bytes a second.
fn bandwidth() -> impl Strategy<Value = f64> {
    (2.0..12.0).prop_map(|power| 10.0_f64.powf(power))
}

fn software() -> impl Strategy<Value = LogGpParameters> {
    let times = [duration(), duration(), duration(), duration(), duration()];
    (times, bandwidth()).prop_map(
        |([send_overhead, latency, hop_time, receive_overhead, gap], bandwidth)| LogGpParameters {
            send_overhead,
            latency,
            hop_time,
            receive_overhead,
            gap,
            bandwidth,
        },
    )
}

fn layer() -> impl Strategy<Value = MessageLayer> {
    let packets = (64_u64..5_000, duration()).prop_map(|(bytes, time)| Packets { bytes, time });
    (
        proptest::option::of(packets),
        proptest::option::of(duration()),
        proptest::option::of(bandwidth()),
        proptest::option::of(100_u64..100_000),
    )
        .prop_map(|(packets, handover, copy_bandwidth, buffer_bytes)| MessageLayer {
            packets,
            handover,
            copy_bandwidth,
            buffer_bytes,
        })
}

fn machine() -> impl Strategy<Value = Machine> {
    let model = prop_oneof![
        Just(NetworkModel::Ideal),
        Just(NetworkModel::LogGp),
        Just(NetworkModel::Wormhole)
    ];
    (software(), layer(), model, -4.0..4.0).prop_map(|(software, layer, model, scale)| {
        let mut machine = paragon();
        machine.parameters.links =
            Some(LinkParameters { bandwidth: software.bandwidth * 2.0, ..links(&machine) });
        machine.parameters.software = Some(software);
        machine.network_model = Some(model);
        machine.message_layer = layer;
        machine.processor.scale = 10.0_f64.powf(scale);
        machine
    })
}

fn links(machine: &Machine) -> LinkParameters {
    machine.parameters.links.clone().unwrap()
}

fn random_rules() -> impl Strategy<Value = Rules> {
    let shooting = (1_u32..3, 1.0..1.5, any::<bool>()).prop_map(|(most, overshoot, ambient)| {
        let split = SourceSplit { nearer_than: f64::INFINITY, most };
        Shooting { split, overshoot, ambient }
    });
    let choices = (any::<[bool; 5]>(), 0..3_usize, any::<u64>());
    (choices, shooting, seconds(), 0.005..0.05, 0.0..0.3).prop_map(
        |((flags, mapping, seed), shooting, every, patch_threshold, energy_threshold)| Rules {
            selection: if flags[0] { Selection::Energy } else { Selection::DeltaRadiosity },
            ties: if flags[1] { Ties::ReceivedFirst } else { Ties::LocalFirst },
            order: if flags[2] { Order::Best } else { Order::InTurn },
            merge_masks: flags[3],
            radiosity_updates: flags[4],
            mapping: [Mapping::Blocks, Mapping::Cyclic, Mapping::Random][mapping],
            seed,
            shooting,
            collect_every: Duration::from_seconds_f64(every.max(1e-3)),
            patch_threshold,
            energy_threshold: if flags[0] { 0.0 } else { energy_threshold },
            ..rules()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn every_run_ends(machine in machine(), rules in random_rules(), processors in 1..9_usize) {
        let run = Run {
            problem: two_rooms_cut([4, 2, 1]),
            processors,
            rules,
            kept: Arc::new(KeptShots::new(64 << 20)),
            on_shot: Arc::new(|_| ()),
        };
        match simulate(&run, &machine) {
            Ok(outcome) => {
                prop_assert!(outcome.energy.error() <= 1e-9);
                if let Ending::TooEarly { lost } = outcome.ending {
                    prop_assert!(lost.is_finite());
                }
            }
            // Processes that wait for room in each other's buffers.
            Err(RunError::Stalled(stalled)) => {
                let cause = stalled.cause.unwrap_or_default();
                prop_assert!(cause.starts_with("deadlock by full buffers"), "{cause}");
            }
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}
