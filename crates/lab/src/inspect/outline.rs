//! What an experiment does, in short, without its scenes and machines.

use std::path::Path;

use config::{Document, Fault, Place, read, read_text};

use crate::experiment::accuracy::REPLACED;
use crate::experiment::fields::Experiment;
use crate::experiment::plot::Plot;
use crate::experiment::sweep::{Sweep, in_words};
use crate::files::find::{FileKind, find_here};
use crate::planning::reading::swept;

/// An experiment in short.
pub struct Outline {
    /// Its title.
    pub title: String,
    /// What it asks, if the page of its folder says so.
    pub question: Option<String>,
    /// The number of its runs.
    pub runs: usize,
    /// The swept fields, the slowest first, and their values.
    pub swept: Vec<(String, Vec<String>)>,
    /// Scene and machine, and the fields that say when a run stops, unless they are swept.
    pub settings: Vec<(String, String)>,
    /// What is drawn, and into which file.
    pub plots: Vec<(String, String)>,
}

impl Outline {
    /// Reads the experiment that a name, or a path to an experiment file, means.
    pub fn open(name: &str) -> Result<Outline, Fault> {
        let found = find_here(&FileKind::EXPERIMENTS, name).map_err(Fault::complete)?;
        let mut document = Document::read(&found.path)?;
        let sweep = swept(&mut document, &[])?;
        let point = &sweep.points[0];
        let first: Experiment = read(&point.value).map_err(|fault| {
            document.fault(&sweep.place_in_file(point, fault.place), fault.message)
        })?;
        let axes = sweep.axes.iter().map(|axis| {
            (axis.place.to_string(), axis.values.iter().map(in_words).collect::<Vec<String>>())
        });
        Ok(Outline {
            title: first.title.clone(),
            question: question(&found.path),
            runs: sweep.points.len(),
            swept: axes.collect(),
            settings: settings(&first, &sweep),
            plots: first.plots.iter().map(|plot| (drawn(plot), plot.file_name())).collect(),
        })
    }
}

fn settings(first: &Experiment, sweep: &Sweep) -> Vec<(String, String)> {
    let mut settings = vec![
        ("scene".to_owned(), first.scene.clone()),
        ("machine".to_owned(), first.machine.name().to_owned()),
    ];
    let stop = serde_json::to_value(&first.stop).unwrap_or_default();
    let stop = stop.as_object().into_iter().flatten();
    settings.extend(stop.map(|(name, value)| {
        let field = format!("stop.{name}");
        let found = first.accuracy.is_some() && REPLACED.contains(&field.as_str());
        let value = if found { "found, so that the error is reached" } else { &in_words(value) };
        (field, value.to_owned())
    }));
    // Those that are swept are among the swept fields.
    let swept: Vec<Place> = sweep.axes.iter().map(|axis| axis.place.clone()).collect();
    settings.retain(|(field, _)| !swept.contains(&Place::of(field)));
    settings
}

fn drawn(plot: &Plot) -> String {
    let series = plot.series.iter().map(|series| format!(", a line for each {series}"));
    format!("{} by {}{}", plot.y, plot.x, series.collect::<String>())
}

/// What the README of the folder asks in its table, in the row that links to the experiment.
fn question(path: &Path) -> Option<String> {
    let page = read_text(&path.with_file_name("README.md")).ok()?;
    let link = format!("]({})", path.file_name()?.to_str()?);
    let mut rows = page.lines().filter(|line| line.starts_with("| ["));
    let row = rows.find(|row| row.contains(&link))?;
    let cell = row.split('|').nth(2)?.trim();
    let words =
        cell.strip_prefix('[').and_then(|cell| cell.split_once("](")).map(|(words, _)| words);
    Some(words.unwrap_or(cell).to_owned())
}
