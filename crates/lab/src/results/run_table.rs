//! The table of a plan's runs: a run and how it ended as a row of runs.csv.

use std::collections::BTreeMap;

use radiosity::Rgb;

use crate::experiment::fields::Experiment;
use crate::experiment::machine::NETWORK_MODEL;
use crate::experiment::sweep::in_words;
use crate::planning::plan::{Plan, Run, all_else};
use crate::results::networks;
use crate::run::runner::{Ending, Endings};
use crate::table::column::{Column, Row};
use crate::table::columns;
use crate::table::comparison::Published;
use crate::table::runs_csv::Table;

pub fn run_table(plan: &Plan, endings: &Endings) -> Table {
    let shown = plan.columns();
    let header = columns::header(&shown, &plan.axes);
    let column = |name: &String| shown.iter().find(|column| column.name == name).copied();
    let cells: Vec<Option<&Column>> = header.iter().map(column).collect();
    let base = plan.speed_up_base();
    let on_base = times_at(plan, endings, "processors", |point| point.processors == base);
    let one_environment =
        times_at(plan, endings, "local_environments", |point| point.local_environments == 1);
    let finest = networks::finest(plan, endings);
    let row = |(run, ending): (&Run, &Option<Ending>)| -> Vec<String> {
        let time_s = time(ending);
        // Without light there is no work to share.
        let lit = plan.problems[run.problem].problem.emitted_power() != Rgb::ZERO;
        let over = |times: &Times, field: &str| {
            let (one, time_s) = (times.get(&all_else(plan, run, field))?, time_s?);
            (lit && time_s > 0.0).then_some(one / time_s)
        };
        let difference = |(_, finest): &(_, f64)| {
            Some((time_s? - finest) / finest).filter(|share| share.is_finite())
        };
        let ending = ending.as_ref();
        let row = Row {
            input: plan.input(run),
            figures: ending.and_then(|ending| ending.as_ref().ok()),
            failure: ending.and_then(|ending| Some(ending.as_ref().err()?.as_str())),
            published: published(plan, run),
            speed_up: over(&on_base, "processors"),
            gain: over(&one_environment, "local_environments"),
            difference_from_finest: finest
                .get(&all_else(plan, run, NETWORK_MODEL))
                .and_then(difference),
        };
        let cell = |(name, column): (&String, &Option<&Column>)| match column {
            Some(column) => row.cell(column),
            None => {
                let mut swept = plan.swept(run);
                let value = swept.find(|(field, _)| field.to_string() == *name);
                value.map_or(String::new(), |(_, value)| in_words(value))
            }
        };
        header.iter().zip(&cells).map(cell).collect()
    };
    let rows = plan.runs.iter().zip(&endings.runs).map(row).collect();
    Table { columns: header, rows }
}

/// What was published of a run. Published speed-ups are over one processor.
fn published(plan: &Plan, run: &Run) -> Published {
    let published = plan.comparison.of(&run.point.scene, run.point.processors);
    match plan.speed_up_base() {
        1 => published,
        _ => Published { speed_up: String::new(), ..published },
    }
}

/// Times of the runs whose value of a field is `chosen`, by the values of all other swept fields, s.
type Times = BTreeMap<Vec<usize>, f64>;

fn times_at(
    plan: &Plan,
    endings: &Endings,
    field: &str,
    chosen: impl Fn(&Experiment) -> bool,
) -> Times {
    let runs = plan.runs.iter().zip(&endings.runs).filter(|(run, _)| chosen(&run.point));
    runs.filter_map(|(run, ending)| Some((all_else(plan, run, field), time(ending)?))).collect()
}

fn time(ending: &Option<Ending>) -> Option<f64> {
    ending.as_ref()?.as_ref().ok()?.time_s
}
