//! The results of an experiment as rows of text: what runs.csv holds, and all that is drawn from.

use std::collections::BTreeMap;

use crate::experiment::fields::Experiment;
use crate::experiment::refine;
use crate::planning::plan::{Plan, Run, all_else};
use crate::results::networks::{self, Finest};
use crate::run::runner::{Ending, Endings};
use crate::table::columns::{self, ENVIRONMENTS, PROCESSORS};

/// Rows under named columns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// One row a run, a cell a column.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The results of a plan's runs, in the plan's order.
    pub fn of(plan: &Plan, endings: &Endings) -> Table {
        let columns = columns::names(&plan.axes, plan.also());
        let one_processor = &alone(plan, endings, PROCESSORS, |point| point.processors);
        let one_environment = &alone(plan, endings, ENVIRONMENTS, |point| point.local_environments);
        let finest = &networks::finest(plan, endings);
        let row = |(run, ending): (&Run, &Option<Ending>)| {
            let ending = ending.as_ref();
            let view = View { plan, run, ending, one_processor, one_environment, finest };
            columns.iter().map(|column| view.cell(column)).collect()
        };
        let rows = plan.runs.iter().zip(&endings.runs).map(row).collect();
        Table { columns, rows }
    }

    /// Reads a runs.csv.
    ///
    /// # Errors
    /// If a row has too few or too many cells, or is no text.
    pub fn from_csv(bytes: &[u8]) -> Result<Table, csv::Error> {
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let mut reader = csv::Reader::from_reader(bytes);
        let columns = cells(reader.headers()?);
        let rows = reader.records().map(|record| Ok(cells(&record?)));
        Ok(Table { columns, rows: rows.collect::<Result<_, csv::Error>>()? })
    }

    /// The table as CSV.
    ///
    /// # Errors
    /// None is known: it is written to memory.
    pub fn to_csv(&self) -> std::io::Result<Vec<u8>> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns)?;
        for row in &self.rows {
            writer.write_record(row)?;
        }
        writer.into_inner().map_err(|error| std::io::Error::other(error.to_string()))
    }

    /// A cell, or one count of a cell of operations; empty if there is no such column.
    pub fn cell<'a>(&'a self, row: &'a [String], column: &str) -> &'a str {
        let [operations, one] = columns::OPERATIONS;
        if let Some(name) = column.strip_prefix(one) {
            let mut counts = self.cell(row, operations).split(' ');
            return counts
                .find_map(|count| count.strip_prefix(name)?.strip_prefix('='))
                .unwrap_or("");
        }
        let index = self.columns.iter().position(|name| name == column);
        index.and_then(|index| row.get(index)).map_or("", String::as_str)
    }

    /// A cell's number and its unit, which may be empty; `None` if it is no number.
    pub fn quantity<'a>(&'a self, row: &'a [String], column: &str) -> Option<(f64, &'a str)> {
        let text = self.cell(row, column).trim();
        let end = text.find(|c: char| !"+-.eE0123456789".contains(c)).unwrap_or(text.len());
        let number = text[..end].parse().ok().filter(|number: &f64| number.is_finite())?;
        Some((number, text[end..].trim()))
    }

    /// A cell as a number, its unit left out; `None` if it is none.
    pub fn number(&self, row: &[String], column: &str) -> Option<f64> {
        self.quantity(row, column).map(|(number, _)| number)
    }
}

/// One run among the others.
struct View<'a> {
    plan: &'a Plan,
    run: &'a Run,
    ending: Option<&'a Ending>,
    one_processor: &'a Alone,
    one_environment: &'a Alone,
    finest: &'a Finest,
}

impl View<'_> {
    fn cell(&self, column: &str) -> String {
        let point = &self.run.point;
        let published = || self.plan.comparison.of(&point.scene, point.processors);
        match column {
            "scene" => point.scene.clone(),
            "processors" => point.processors.to_string(),
            "local_environments" => point.local_environments.to_string(),
            "seed" => point.seed.to_string(),
            "speed_up" => self.speed_up().map_or(String::new(), |s| format!("{s:.4}")),
            // Figure 11: time with one local environment, all else equal, over this run's time.
            "gain" => {
                let gain = self.gain(self.one_environment, ENVIRONMENTS);
                gain.map_or(String::new(), |gain| format!("{gain:.4}"))
            }
            "efficiency" => {
                let share = self.speed_up().map(|s| s / f64::from(point.processors));
                share.map_or(String::new(), |share| format!("{share:.4}"))
            }
            "difference_from_finest" => self.difference().unwrap_or_default(),
            "paper_time_s" => published().time_s,
            "paper_speed_up" => published().speed_up,
            _ => {
                let tuned = || self.run.tuned.and_then(|tuned| tuned.cell(column));
                let problem = &self.plan.problems[self.run.problem].problem;
                let pilot = || refine::cell(problem.refinement.as_ref()?, column);
                self.swept(column)
                    .or_else(tuned)
                    .or_else(pilot)
                    .unwrap_or_else(|| self.figure(column))
            }
        }
    }

    /// The value of a swept field.
    fn swept(&self, column: &str) -> Option<String> {
        let mut axes = self.plan.axes.iter().zip(&self.run.index);
        let (axis, &item) = axes.find(|(axis, _)| axis.place.to_string() == column)?;
        Some(columns::cell(&axis.values[item]))
    }

    fn figure(&self, column: &str) -> String {
        match (self.ending, column) {
            (Some(Ok(figures)), _) => columns::figure(figures, column).unwrap_or_default(),
            (Some(Err(_)), "ending") => "failed".to_owned(),
            (Some(Err(message)), "failure") => message.clone(),
            _ => String::new(),
        }
    }

    /// How far this run's time is from that on the finest network run, all else equal.
    fn difference(&self) -> Option<String> {
        let (_, finest) = self.finest.get(&all_else(self.plan, self.run, "network"))?;
        let part = (self.ending?.as_ref().ok()?.time_s? - finest) / finest;
        part.is_finite().then(|| format!("{:.6} %", part * 100.0))
    }

    /// Time on one processor, all else equal, over this run's time.
    fn speed_up(&self) -> Option<f64> {
        self.gain(self.one_processor, PROCESSORS)
    }

    fn gain(&self, alone: &Alone, field: &str) -> Option<f64> {
        let one = alone.get(&all_else(self.plan, self.run, field))?;
        let time = self.ending?.as_ref().ok()?.time_s?;
        (time > 0.0).then_some(one / time)
    }
}

/// Times of the runs for which a field is 1, by all that is swept besides it.
type Alone = BTreeMap<Vec<usize>, f64>;

fn alone(plan: &Plan, endings: &Endings, field: &str, value: fn(&Experiment) -> u32) -> Alone {
    let runs = plan.runs.iter().zip(&endings.runs).filter(|(run, _)| value(&run.point) == 1);
    let time = |ending: &Option<Ending>| ending.as_ref()?.as_ref().ok()?.time_s;
    runs.filter_map(|(run, ending)| Some((all_else(plan, run, field), time(ending)?))).collect()
}
