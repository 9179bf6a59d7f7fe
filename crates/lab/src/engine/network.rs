//! Simulates a run on the network model that its machine asks for; figures of the network.

use multicomputer::{AutoResult, Machine, NetworkModel, Recorder};
use serde::{Deserialize, Serialize};
use virtwall::{Outcome, Run, RunError, SharedObserver, simulate_observed};

use crate::experiment::fields::Experiment;

/// How far "auto" may be from the next finer model, unless the experiment says.
const TOLERANCE: f64 = 0.01;

/// Figures of the network in a run's results, if an experiment chooses a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NetworkFigures {
    /// The name of the model that was used.
    pub model: String,
    /// Why the automatic choice took it.
    pub why: String,
    pub busiest_link: Option<f64>,
    pub blocked_s: f64,
}

/// Whether results have figures of the network: if an experiment chooses the model, or leaves it open.
pub fn tells(machine: &Machine, point: &Experiment) -> bool {
    point.machine.chooses_network_model() || is_open(machine)
}

/// Whether the model is chosen by simulating runs. Observing a run then takes one more simulation.
pub fn is_open(machine: &Machine) -> bool {
    machine.network_model.is_none()
}

/// Simulates a run on the machine's model of its network, with an observer.
pub fn simulate(
    run: &Run,
    machine: &Machine,
    point: &Experiment,
    observer: Option<SharedObserver>,
) -> Result<(Outcome, Option<NetworkFigures>), RunError> {
    if !tells(machine, point) {
        return Ok((simulate_observed(run, machine, machine.network(), observer)?, None));
    }
    let over = |network| {
        let outcome = simulate_observed(run, machine, network, None)?;
        Ok::<_, RunError>((outcome.time, outcome))
    };
    let chosen = match machine.network_model {
        None => {
            let tolerance = point.network_tolerance.as_ref().map_or(TOLERANCE, |t| t.value());
            let chosen =
                multicomputer::choose(&machine.parameters, machine.topology(), tolerance, over)?;
            if observer.is_some() {
                // Pilot runs are not observed: only at the end is it known which of them is the final one.
                simulate_observed(run, machine, machine.network_on(chosen.model)?, observer)?;
            }
            chosen
        }
        Some(model) => {
            let (network, record) = Recorder::new(machine.network_on(model)?);
            let answer = simulate_observed(run, machine, Box::new(network), observer)?;
            let time = answer.time;
            AutoResult { model, answer, time, record: record.take(), why: String::new() }
        }
    };
    let figures = figures(machine, &chosen);
    Ok((chosen.answer, Some(figures)))
}

/// The network model of a run. If the machine leaves it open, a simulation chooses it.
pub fn model_used(
    run: &Run,
    machine: &Machine,
    point: &Experiment,
) -> Result<NetworkModel, RunError> {
    if let Some(model) = machine.network_model {
        return Ok(model);
    }
    let (_, figures) = simulate(run, machine, point, None)?;
    Ok(figures.and_then(|figures| figures.model.parse().ok()).unwrap_or(NetworkModel::LogGp))
}

fn figures(machine: &Machine, chosen: &AutoResult<Outcome>) -> NetworkFigures {
    let AutoResult { record, time, .. } = chosen;
    let links = machine.parameters.links.as_ref();
    NetworkFigures {
        model: chosen.model.to_string(),
        why: chosen.why.clone(),
        busiest_link: links.map(|links| record.busiest_link(machine.topology(), links, *time)),
        blocked_s: record.blocked().as_seconds_f64(),
    }
}
