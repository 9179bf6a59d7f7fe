//! Which runs of a sweep the report's viewer shows.

use crate::planning::plan::Plan;

/// The most runs that are all recorded by default.
const FEW: usize = 32;

/// Which runs a report shows in its viewer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Viewing {
    /// All of a few; of many, for each scene those on the fewest and on the most processors.
    #[default]
    Automatic,
    /// All.
    All,
    /// None: the report has only tables and plots.
    None,
    /// These, by row of runs.csv, from 1.
    Rows(Vec<usize>),
}

impl Viewing {
    /// Makes sure that the rows asked for exist.
    pub fn check(&self, plan: &Plan) -> Result<(), String> {
        let runs = plan.runs.len();
        let Viewing::Rows(rows) = self else { return Ok(()) };
        let missing = rows.iter().find(|row| !(1..=runs).contains(row));
        missing.map_or(Ok(()), |row| {
            Err(format!("--viewer: no row {row}; expected rows from 1 to {runs}"))
        })
    }

    /// Whether each run of a plan is recorded.
    pub fn chosen(&self, plan: &Plan) -> Vec<bool> {
        let runs = plan.runs.len();
        match self {
            Viewing::None => vec![false; runs],
            Viewing::Rows(rows) => (1..=runs).map(|row| rows.contains(&row)).collect(),
            Viewing::Automatic if runs > FEW => ends(plan),
            Viewing::Automatic | Viewing::All => vec![true; runs],
        }
    }
}

/// Chooses for each scene the first run on the fewest and the first on the most processors.
fn ends(plan: &Plan) -> Vec<bool> {
    let mut chosen = vec![false; plan.runs.len()];
    let mut scenes: Vec<&str> = plan.runs.iter().map(|run| run.point.scene.as_str()).collect();
    scenes.sort_unstable();
    scenes.dedup();
    for scene in scenes {
        let mine = || (0..chosen.len()).filter(|&run| plan.runs[run].point.scene == scene);
        let processors = |&run: &usize| plan.runs[run].point.processors;
        let ends = [mine().min_by_key(processors), mine().rev().max_by_key(processors)];
        ends.into_iter().flatten().for_each(|run| chosen[run] = true);
    }
    chosen
}
