//! What a report tells its viewer of a run.

use std::sync::Arc;

use multicomputer::{Machine, Shape};
use radiosity::Rgb;
use serde_json::{Value, json};
use virtwall::Problem;

use crate::critical::{Link, critical_path};
use crate::film::Film;
use crate::ledger::Account;

/// A recorded run, and what it was a run of.
pub struct Reel<'a> {
    /// Its name among all runs of the report.
    pub label: String,
    /// Its scene's name.
    pub scene: String,
    /// Runs of one group differ in nothing but the number of processors.
    pub group: usize,
    /// What was simulated.
    pub problem: &'a Arc<Problem>,
    /// On what.
    pub machine: &'a Machine,
    /// The processor of each environment.
    pub owners: Vec<usize>,
    /// The radiosity that each patch should have, W/m², where that is known; the same for all runs of a
    /// problem.
    pub answer: Option<Arc<Vec<Rgb>>>,
    /// The speed-up that was published for such a run, if one was.
    pub published: Option<f64>,
    /// What happened.
    pub film: &'a Film,
}

/// A reel with what was found out about it.
pub(crate) struct Told<'a> {
    pub reel: &'a Reel<'a>,
    pub path: Vec<Link>,
    pub account: Account,
}

impl<'a> Told<'a> {
    pub fn of(reel: &'a Reel<'a>) -> Told<'a> {
        let path = critical_path(&reel.film.recording);
        let account = Account::of(&reel.film.recording, &path);
        Told { reel, path, account }
    }

    /// Virtual time of the whole run, seconds.
    pub fn seconds(&self) -> f64 {
        self.account.last.1.as_seconds_f64()
    }

    pub fn processors(&self) -> usize {
        self.reel.film.processors()
    }
}

/// Where the ranks of a run stand on its machine, the service node last.
pub(crate) fn places(machine: &Machine, processors: usize) -> Value {
    let topology = machine.topology();
    let places = topology.places().max(1);
    let (width, height, mesh) = match topology.shape() {
        Shape::Mesh { width, height } => (usize::from(width), usize::from(height), true),
        Shape::Torus { width, height } => (usize::from(width), usize::from(height), false),
        Shape::Crossbar { .. } | Shape::Bus { .. } => {
            let width = places.isqrt().max(1);
            (width, places.div_ceil(width), false)
        }
    };
    let ranks = (0..processors).chain([machine.compute_nodes()]);
    json!({ "width": width, "height": height, "mesh": mesh, "places": ranks.collect::<Vec<_>>() })
}
