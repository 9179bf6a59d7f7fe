use desim::{Duration, Time};
use multicomputer::*;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).map(|t| t.parse().unwrap()).collect();
    let (flit, buffer, bw) = (a[0] as u64, a[1] as u32, a[2] * 1e6);
    let topology = Topology::new(Shape::Mesh { width: 8, height: 8 });
    let zero = Duration::ZERO;
    let software = LogGpParameters {
        send_overhead: zero,
        latency: zero,
        hop_time: Duration(40_000),
        receive_overhead: zero,
        gap: zero,
        bandwidth: bw,
    };
    let links = LinkParameters {
        bandwidth: 175e6,
        flit_bytes: flit,
        buffer_flits: buffer,
        virtual_channels: 1,
    };
    for pattern in Pattern::ALL {
        for share in [0.01, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5] {
            let share = if pattern == Pattern::AllToOne {
                share / 16.
            } else if pattern == Pattern::HotSpot {
                share / 4.
            } else {
                share
            };
            let every = Duration::from_seconds_f64(4096.0 / 175e6 / share);
            let load = Load { pattern, bytes: 4096, every, until: Time(every.0 * 160), seed: 1 };
            let trace = load.trace(&topology, 64);
            let m = [Rung::Wormhole, Rung::Flit].map(|rung| {
                let mut network: Box<dyn Network> = match rung {
                    Rung::Wormhole => {
                        Box::new(Wormhole::new(software.clone(), links.clone(), &topology))
                    }
                    _ => Box::new(Flit::new(software.clone(), links.clone(), &topology)),
                };
                let courses = replay(&trace, network.as_mut(), &topology).unwrap();
                Measured::of(&load, &trace, &courses)
            });
            println!(
                "{:10} load {share:.4} {} messages, latency {:.1} {:.1} us {:+.1} %, accepted {:.4} {:.4}",
                pattern.name(),
                m[0].messages,
                m[0].latency * 1e6,
                m[1].latency * 1e6,
                (m[0].latency / m[1].latency - 1.) * 100.,
                m[0].throughput / 64.0 / 175e6,
                m[1].throughput / 64.0 / 175e6
            );
            if m[1].latency > 6. * 4096. / 175e6 {
                break;
            }
        }
    }
}
