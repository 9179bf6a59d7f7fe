//! Where the error of a run comes from. Causes are switched off one after the other; each contributes the change
//! that switching it off makes.

use std::sync::Arc;

use multicomputer::{Machine, NetworkModel};
use radiosity::Rgb;
use radiosity::glam::DVec3;
use reference::Centres;
use virtwall::{KeptShots, Problem};

use crate::accuracy::answer::Answer;
use crate::accuracy::errors::ErrorMeasure;
use crate::engine::error_figures::Causes;
use crate::engine::simulator::{self, On};
use crate::experiment::fields::{Experiment, Stop};
use crate::files::quantity::Fraction;

/// Threshold of a patch, as a share of the brightest, at which all counts as shot.
const ALL_SHOT: &str = "0.0001 %";

/// A run whose error is to be explained.
pub struct Explained<'a> {
    pub point: &'a Experiment,
    pub problem: &'a Arc<Problem>,
    /// The machine; its times do not matter here.
    pub machine: &'a Machine,
    pub kept: &'a Arc<KeptShots>,
}

impl Explained<'_> {
    /// The parts of the run's error, by way of the dense solution of its own mesh.
    pub fn causes(
        &self,
        radiosity: &[Vec<Rgb>],
        measure: &ErrorMeasure,
        dense: &Answer,
    ) -> Result<Causes, String> {
        let all_shot = Experiment {
            stop: Stop {
                patch_threshold: Fraction::parse(ALL_SHOT)?,
                energy_threshold: Fraction::parse("0 %")?,
                ..self.point.stop.clone()
            },
            overshoot: 1.0,
            ambient: false,
            ..self.point.clone()
        };
        // From the run itself to the answer, one cause less at each step.
        let steps = [
            radiosity.concat(),
            self.run(&all_shot)?,
            self.centres(dense).solve(),
            dense.radiosity.clone(),
        ];
        let mut means: Vec<Vec<Rgb>> =
            steps.iter().map(|step| measure.overlaps.means(step)).collect();
        means.push(measure.answer.radiosity.clone());
        let part = |step: usize| measure.between(&means[step], &means[step + 1]).relative_l2;
        Ok(Causes { stopping: part(0), directions: part(1), sampling: part(2), mesh: part(3) })
    }

    /// Radiosities of another run of the problem, one environment after the other.
    fn run(&self, point: &Experiment) -> Result<Vec<Rgb>, String> {
        let mut machine = self.machine.clone();
        machine.network_model = Some(NetworkModel::Ideal);
        let run = simulator::run(self.problem, point, self.kept, Arc::new(|_| ()));
        let (_, radiosity) = simulator::carry_out(&run, point, On::Simulation, &machine, 0, None)?;
        Ok(radiosity.concat())
    }

    /// The system of shooting from the run's own points with a ray in every direction.
    fn centres(&self, dense: &Answer) -> Centres {
        let space = &self.problem.space;
        let split = simulator::shooting(self.point).split;
        let points = self.problem.environments.iter().flat_map(|environment| {
            (0..environment.patches.len() as u32).map(move |patch| {
                let parts = split.parts(space, environment, patch);
                parts.iter().map(|part| (part.centre, part.share)).collect::<Vec<(DVec3, f64)>>()
            })
        });
        let points: Vec<_> = points.collect();
        Centres::new(&space.scene, dense.patches.clone(), &points, parallel::host_threads())
    }
}
