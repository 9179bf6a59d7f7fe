//! Which runs of a sweep are recorded for the report's viewer, and what it is told of them.

use std::cell::RefCell;
use std::io;
use std::rc::Rc;

use viewer::{Film, Recorded, Reel};
use virtwall::{Observer, Run};

use crate::columns;
use crate::engine;
use crate::plan::{Plan, all_else};

/// The most runs that are all recorded by default.
const FEW: usize = 32;

/// Bytes that recordings may take in a report, about.
const LIMIT: usize = 19_000_000;

/// Which runs a report shows in its viewer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Viewing {
    /// All of a few; of many, for each scene those on the fewest and on the most processors.
    #[default]
    Automatic,
    /// All.
    All,
    /// None: the report has tables and plots alone.
    None,
    /// These, by row of runs.csv, from 1.
    Rows(Vec<usize>),
}

impl Viewing {
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

/// Of the runs of each scene the first ones on the fewest and on the most processors.
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

/// Films a run; where it takes several simulations, the last one.
pub struct Camera<'a> {
    run: &'a Run,
    on: bool,
    film: RefCell<Option<Rc<RefCell<Film>>>>,
}

impl<'a> Camera<'a> {
    /// For a run, if it is to be recorded.
    pub fn of(run: &'a Run, on: bool) -> Camera<'a> {
        Camera { run, on, film: RefCell::new(None) }
    }

    /// Who observes the next simulation.
    pub fn observer(&self) -> Option<Rc<RefCell<dyn Observer>>> {
        let film = || Rc::new(RefCell::new(Film::new(&self.run.problem, self.run.processors)));
        let film = self.on.then(film)?;
        *self.film.borrow_mut() = Some(Rc::clone(&film));
        Some(film)
    }

    /// The film of the last simulation.
    pub fn film(self) -> Option<Film> {
        let film = self.film.into_inner()?;
        Rc::into_inner(film).map(RefCell::into_inner)
    }
}

/// The recordings of a plan's runs, packed; none if there are none.
///
/// # Errors
/// None is known: all is made in memory.
pub fn recorded(plan: &Plan, films: &[Option<Film>]) -> io::Result<Option<Recorded>> {
    let mut groups: Vec<(usize, Vec<usize>)> = Vec::new();
    let mut reels = Vec::new();
    for (run, film) in plan.runs.iter().zip(films) {
        let Some(film) = film else { continue };
        let key = (run.problem, all_else(plan, run, "processors"));
        let group = groups.iter().position(|known| *known == key).unwrap_or(groups.len());
        if group == groups.len() {
            groups.push(key);
        }
        let problem = &plan.problems[run.problem].problem;
        reels.push(Reel {
            label: label(plan, run),
            scene: run.point.scene.clone(),
            group,
            problem,
            machine: &plan.machines[run.machine].machine,
            owners: engine::owners(&run.point, problem),
            film,
        });
    }
    if reels.is_empty() { Ok(None) } else { Recorded::of(&reels, LIMIT).map(Some) }
}

/// What tells a run from the others: its scene, its processors, and whatever else is swept.
fn label(plan: &Plan, run: &crate::plan::Run) -> String {
    let plural = if run.point.processors == 1 { "" } else { "s" };
    let mut label = format!("{}, {} processor{plural}", run.point.scene, run.point.processors);
    for (axis, &item) in plan.axes.iter().zip(&run.index) {
        let field = axis.place.to_string();
        if !["scene", "processors"].contains(&field.as_str()) {
            label += &format!(", {field} {}", columns::cell(&axis.values[item]));
        }
    }
    label
}
