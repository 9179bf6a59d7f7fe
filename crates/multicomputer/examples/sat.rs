use desim::{Duration, Time};
use multicomputer::*;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).map(|t| t.parse().unwrap()).collect();
    let (hop, cycles) = (a[0] as u64, a[1] as u64);
    for load in &a[2..] {
        let topology = Topology::new(Shape::Mesh { width: 8, height: 8 });
        let zero = Duration::ZERO;
        let software = LogGpParameters {
            send_overhead: zero,
            latency: zero,
            hop_time: Duration(1000 * hop),
            receive_overhead: zero,
            gap: zero,
            bandwidth: 1e9,
        };
        let links =
            LinkParameters { bandwidth: 1e9, flit_bytes: 1, buffer_flits: 8, virtual_channels: 1 };
        let mut network = Flit::new(software, links, &topology);
        let load_ = Load {
            pattern: Pattern::Uniform,
            bytes: 20,
            every: Duration((20_000.0 / load) as u64),
            until: Time(cycles * 1000),
            seed: 1,
        };
        let trace = load_.trace(&topology, 64);
        let courses = replay(&trace, &mut network, &topology).unwrap();
        let m = Measured::of(&load_, &trace, &courses);
        println!(
            "hop {hop} load {load} {} messages, latency {:.1} cycles, accepted {:.4}",
            m.messages,
            m.latency * 1e9,
            m.throughput / 64.0 / 1e9
        );
    }
}
