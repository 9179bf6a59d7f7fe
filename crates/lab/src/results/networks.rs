//! Network models compared: errors of the coarser ones, and the cost of each.

use std::collections::BTreeMap;

use multicomputer::NetworkModel;

use crate::experiment::machine::NETWORK_MODEL;
use crate::planning::plan::{Plan, all_else};
use crate::run::runner::{Ending, Endings};

/// The finest network model with a run, and the run's virtual seconds, by the values of all other swept
/// fields.
pub type Finest = BTreeMap<Vec<usize>, (NetworkModel, f64)>;

pub fn finest(plan: &Plan, endings: &Endings) -> Finest {
    let mut finest = Finest::new();
    for (run, ending) in plan.runs.iter().zip(&endings.runs) {
        let Some((model, time)) = ending.as_ref().and_then(of) else { continue };
        let found = finest.entry(all_else(plan, run, NETWORK_MODEL)).or_insert((model, time));
        if model > found.0 {
            *found = (model, time);
        }
    }
    finest
}

/// The network model of a run that has figures of its network, and the run's virtual seconds.
fn of(ending: &Ending) -> Option<(NetworkModel, f64)> {
    let figures = ending.as_ref().ok()?;
    let model = figures.network.as_ref()?.model.parse().ok()?;
    Some((model, figures.time_s?))
}

/// For each model of a sweep over networks, its largest difference from the finest, and the host time of its
/// runs; empty without such a sweep, and of runs without virtual time. Shots are kept from run to run, so the first model pays for casting them.
pub fn text(plan: &Plan, endings: &Endings) -> String {
    let Some(axis) = plan.axes.iter().position(|axis| axis.place.to_string() == NETWORK_MODEL)
    else {
        return String::new();
    };
    let finest = finest(plan, endings);
    if finest.is_empty() {
        return String::new();
    }
    let mut text = format!("{:>9}{:>27}{:>10}\n", "network", "farthest from the finest", "CPU s");
    for (item, value) in plan.axes[axis].values.iter().enumerate() {
        let runs = plan.runs.iter().zip(endings.runs.iter().zip(&endings.host));
        let (mut farthest, mut seconds) = (0.0_f64, 0.0);
        for (run, (ending, host)) in runs.filter(|(run, _)| run.index[axis] == item) {
            seconds += host.map_or(0.0, |host| host.cpu_s);
            let time = ending.as_ref().and_then(of).map(|(_, time)| time);
            let best = finest.get(&all_else(plan, run, NETWORK_MODEL));
            if let Some((time, (_, best))) = time.zip(best) {
                farthest = farthest.max(((time - best) / best).abs());
            }
        }
        let name = value.as_str().unwrap_or_default();
        text += &format!("{name:>9}{:>25.5} %{seconds:>10.1}\n", farthest * 100.0);
    }
    text
}
