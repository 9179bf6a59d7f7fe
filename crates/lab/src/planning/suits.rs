//! Whether a machine suits what an experiment asks of it.

use multicomputer::Machine;

use crate::engine::knobs;
use crate::engine::network;
use crate::experiment::fields::Experiment;
use crate::files::fault::WrongField;

/// Most local environments: more are taken for a mistake.
const MOST_ENVIRONMENTS: u32 = 65_536;

/// Refuses what the machine does not have.
///
/// # Errors
/// The experiment's field at fault, and what is wrong with it.
pub fn suits(typed: &Experiment, machine: &Machine) -> Result<(), WrongField> {
    let (processors, environments) = (typed.processors, typed.local_environments);
    if !(1..=MOST_ENVIRONMENTS).contains(&environments) {
        let message = format!("{environments}; expected 1 to {MOST_ENVIRONMENTS}");
        return Err(("local_environments", message));
    }
    if processors == 0 {
        return Err(("processors", "0; expected 1 or more".to_owned()));
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
    if let Some((field, what)) = lacks(machine, typed) {
        let message = format!("the {what} of \"{}\" is not modelled", typed.machine);
        let section = if field == "count_start_up" { "start_up" } else { field };
        let message = message + &format!("; expected a machine whose file has \"{section}\"");
        return Err((field, message));
    }
    network::check(machine, typed.network).map_err(|error| ("network", error.to_string()))?;
    knobs::check(typed)
}

/// The first field that asks for what a machine does not model, and what that is.
fn lacks(machine: &Machine, typed: &Experiment) -> Option<(&'static str, &'static str)> {
    if machine.node_memory.is_none() && !typed.node_memory.is_empty() {
        return Some(("node_memory", "memory"));
    }
    if machine.display.is_none() && !typed.display.is_empty() {
        return Some(("display", "display"));
    }
    (machine.start_up.is_none() && typed.count_start_up).then_some(("count_start_up", "start-up"))
}
