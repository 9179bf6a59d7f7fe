//! Checks that a machine has what an experiment needs.

use multicomputer::Machine;

use crate::engine::knobs;
use crate::experiment::fields::Experiment;
use crate::files::WrongField;

/// Most local environments: more are taken for a mistake.
const MOST_ENVIRONMENTS: u32 = 65_536;

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
    if machine.start_up.is_none() && typed.count_start_up {
        let message = format!("the start-up of \"{}\" is not modelled", typed.machine);
        let message = message + "; expected a machine whose file has \"start_up\"";
        return Err(("count_start_up", message));
    }
    knobs::check(typed)
}
