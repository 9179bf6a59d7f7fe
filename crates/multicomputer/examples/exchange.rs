//! The exchange that measures the speed of the network models: `exchange MODEL [ROUNDS]`; time it from
//! outside. 56 nodes send 4 KB to 4 neighbours each, 1,000 times.

use multicomputer::{Machine, NetworkModel, exchange};

const PARAGON: &str = include_str!("../../../machines/paragon-xps.json");

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let model: NetworkModel = arguments.next().as_deref().unwrap_or("loggp").parse()?;
    let rounds = arguments.next().map_or(Ok(1_000), |text| text.parse())?;
    let machine = Machine::from_json(PARAGON, "machines/paragon-xps.json")?;
    let end = exchange(&machine, machine.network_on(model)?, 56, 4_096, rounds)?;
    println!("{} messages over {model}: {end}", 56 * 4 * rounds);
    Ok(())
}
