//! Checks the values of an experiment, and that a machine has what they need.

use multicomputer::Machine;

use crate::experiment::fields::Experiment;
use crate::experiment::refine::MOST_HALVINGS;
use crate::experiment::source_split::SplitFields;
use crate::files::WrongField;

/// The parts that a patch may be cut into along a direction.
const MOST_PARTS: u32 = 64;

/// Most local environments: more are taken for a mistake.
const MOST_ENVIRONMENTS: u32 = 65_536;

/// The most memory of the host that the simulated caches of all processors of a run may take, bytes; each line
/// takes [`LINE_BYTES`].
const MOST_CACHE_BYTES: u128 = 1 << 30;
const LINE_BYTES: u128 = 8;

pub fn suits(typed: &Experiment, machine: &Machine) -> Result<(), WrongField> {
    let (processors, environments) = (typed.processors, typed.local_environments);
    if !(1..=MOST_ENVIRONMENTS).contains(&environments) {
        let message = format!("{environments}; expected 1 to {MOST_ENVIRONMENTS}");
        return Err(("local_environments", message));
    }
    if processors == 0 {
        return Err(("processors", "0; expected 1 or more".to_owned()));
    }
    if typed.speed_up_over == Some(0) {
        return Err(("speed_up_over", "0; expected 1 or more".to_owned()));
    }
    if processors > environments {
        let message = format!("{processors} processors for {environments} local environments");
        return Err(("processors", message + "; expected at most one for each"));
    }
    let nodes = machine.compute_nodes();
    if processors as usize > nodes {
        let message = format!(
            "{processors} processors, but \"{}\" has {nodes} compute nodes; expected at most that",
            typed.machine
        );
        return Err(("processors", message));
    }
    cache_memory(typed, machine)?;
    if machine.start_up.is_none() && typed.count_start_up {
        let message = format!("the start-up of \"{}\" is not modelled", typed.machine);
        let message = message + "; expected a machine whose file has \"start_up\"";
        return Err(("count_start_up", message));
    }
    typed.stop.check()?;
    let SplitFields { most, nearer_than } = typed.source_split;
    if !(1..=MOST_PARTS).contains(&most) {
        return Err(("source_split.most", format!("{most}; expected 1 to {MOST_PARTS}")));
    }
    if let Some(edges) = nearer_than.filter(|edges| !(edges.is_finite() && *edges > 0.0)) {
        return Err(("source_split.nearer_than", format!("{edges}; expected more than 0")));
    }
    if !(1.0..2.0).contains(&typed.overshoot) {
        let message = format!("{}; expected from 1 to less than 2", typed.overshoot);
        return Err(("overshoot", message));
    }
    if let Some(error) = typed.refine.relative_l2.filter(|error| !(*error > 0.0 && *error < 1.0)) {
        return Err(("refine.relative_l2", format!("{error}; expected more than 0, less than 1")));
    }
    if !(1..=MOST_HALVINGS).contains(&typed.refine.most_halvings) {
        let message = format!("{}; expected 1 to {MOST_HALVINGS}", typed.refine.most_halvings);
        return Err(("refine.most_halvings", message));
    }
    if let Some(least) = typed.hemisphere.least_pixels
        && !(1..=typed.hemisphere.pixels).contains(&least)
    {
        let message = format!("{least}; expected 1 to {}, the pixels", typed.hemisphere.pixels);
        return Err(("hemisphere.least_pixels", message));
    }
    Ok(())
}

/// Whether the host has memory for the simulated caches of all processors.
fn cache_memory(typed: &Experiment, machine: &Machine) -> Result<(), WrongField> {
    let (lines, processors) = (machine.processor.cache_lines(), typed.processors);
    let bytes = LINE_BYTES * u128::from(lines) * u128::from(processors);
    if bytes > MOST_CACHE_BYTES {
        let message = format!(
            "the caches of \"{}\" need {bytes} B of this computer's memory: {processors} processors x \
             {lines} lines x {LINE_BYTES} B; expected at most {MOST_CACHE_BYTES} B",
            typed.machine
        );
        return Err(("machine", message));
    }
    Ok(())
}
