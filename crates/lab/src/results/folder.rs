//! A folder of results: writes it, and reads it to draw plots and report again.

use std::fs;
use std::io;
use std::path::Path;

use config::{Document, Fault, Place, read, read_bytes, unreadable};
use serde_json::{Map, Value, json};
use viewer::ReportParts;

use crate::engine::simulator::On;
use crate::experiment::plot::Plot;
use crate::files::digest::sha256;
use crate::files::file::{self, PLAIN, is_plain};
use crate::host::host_clock::HostTimes;
use crate::planning::plan::Plan;
use crate::results::chart;
use crate::results::console::table_text;
use crate::results::host_times;
use crate::results::operations;
use crate::results::recordings;
use crate::results::repeats_csv;
use crate::results::report;
use crate::results::run_table::run_table;
use crate::results::without_time;
use crate::run::runner::{Endings, Options};
use crate::run::saved::Saved;
use crate::table::cheapest;
use crate::table::runs_csv::Table;

/// The results of an experiment: all that its plots and its report are drawn from.
pub struct Results {
    /// One row a run.
    pub table: Table,
    /// Configuration, seed, versions and digests.
    pub manifest: Value,
    /// What the report's viewer shows, if runs were recorded.
    recorded: Option<ReportParts>,
}

impl Results {
    /// The results of a plan that was carried out with these options.
    pub fn of(plan: &Plan, endings: &Endings, options: &Options) -> io::Result<Results> {
        let table = run_table(plan, endings);
        let manifest = manifest(plan, &table, options.on)?;
        let recorded = recordings::recorded(plan, endings, options.threads.max(1));
        Ok(Results { table, manifest, recorded })
    }

    /// Reads a folder of results.
    ///
    /// # Errors
    /// If a file is missing, damaged or changed since it was written.
    pub fn read(folder: &Path) -> Result<Results, Fault> {
        let path = folder.join("manifest.json");
        if !path.is_file() {
            let message = "no manifest.json in it; expected a folder that `run` wrote";
            return Err(Fault::of_file(folder.display(), message));
        }
        let document = Document::read(&path)?;
        let csv = folder.join("runs.csv");
        let bytes = read_bytes(&csv)?;
        if document.value["runs_csv_sha256"] != Value::String(sha256(&bytes)) {
            let message =
                "does not have the digest that manifest.json states; expected it unchanged";
            return Err(Fault::of_file(csv.display(), message));
        }
        let plots = &document.value["experiment"]["plots"];
        let place = Place::of("experiment.plots");
        let plots =
            read::<Vec<Plot>>(plots).map_err(|fault| document.fault(&place, fault.message))?;
        for plot in plots {
            if !is_plain(&plot.stem()) {
                let message = format!("\"{}\" names a file; expected {PLAIN}", plot.stem());
                return Err(document.fault(&place, message));
            }
        }
        let table = Table::from_csv(&bytes).map_err(|error| unreadable(&csv, error))?;
        // Recordings are only in the report.
        let report = fs::read_to_string(folder.join("report.html")).ok();
        let recorded = report.and_then(|html| ReportParts::in_report(&html));
        Ok(Results { table, manifest: document.value, recorded })
    }

    /// Writes all files of results, each whole, and then deletes the runs saved one by one,
    /// unless some have failed.
    pub fn write(&self, out: &Path) -> io::Result<()> {
        if let Some((row, column)) = self.table.not_finite() {
            let message = format!("run {row}: {column} is not a finite number; nothing is written");
            return Err(io::Error::other(message));
        }
        file::make_folder(out)?;
        let before = figures(&out.join("manifest.json"));
        // The manifest first: a table without one is not from a run.
        file::write(&out.join("manifest.json"), pretty(&self.manifest)?.as_bytes())?;
        file::write(&out.join("runs.csv"), &self.table.to_csv()?)?;
        self.draw_in_place_of(&before, out)?;
        if self.failures() == 0 {
            Saved::in_folder(out).forget()?;
        }
        Ok(())
    }

    /// Writes the manifest if it is another one, and draws; removes figures of before that are no longer asked for.
    /// Returns the names of the files drawn.
    pub fn present_in(&self, out: &Path) -> io::Result<Vec<String>> {
        let path = out.join("manifest.json");
        let before = figures(&path);
        let same = Document::read(&path).is_ok_and(|document| document.value == self.manifest);
        if !same {
            file::write(&path, pretty(&self.manifest)?.as_bytes())?;
        }
        self.draw_in_place_of(&before, out)
    }

    fn draw_in_place_of(&self, before: &[String], out: &Path) -> io::Result<Vec<String>> {
        let names = self.draw(out)?;
        let stale = before.iter().filter(|name| !names.contains(name));
        stale.into_iter().try_for_each(|name| file::remove(&out.join(name)))?;
        Ok(names)
    }

    /// Writes what is made of runs.csv into a folder: the table of operations, plots and report, with the host times
    /// in it; returns the names of the files.
    pub fn draw(&self, out: &Path) -> io::Result<Vec<String>> {
        let sweeps = self.sweeps();
        let operations = operations::operations(&self.table, &sweeps).to_csv()?;
        file::write(&out.join(operations::FILE), &operations)?;
        let mut names = vec![operations::FILE.to_owned()];
        let mut drawings = Vec::new();
        let table = host_times::beside(&self.table, out);
        let note = without_time::note(&self.manifest);
        let titled = |plot: Plot| match note {
            Some(_) => without_time::titled(&plot, &table),
            None => plot,
        };
        let plots: Vec<Plot> = self.plots().into_iter().map(titled).collect();
        for plot in &plots {
            let svg = chart::svg(&table, &sweeps, plot, self.speed_up_base());
            let name = plot.file_name();
            file::write(&out.join(&name), svg.as_bytes())?;
            names.push(name);
            // The report is the same on every host.
            if !host_times::shown_in(plot) {
                drawings.push(svg);
            }
        }
        if let Some(summary) = repeats_csv::summary(&table, &sweeps, &plots) {
            file::write(&out.join(repeats_csv::FILE), &summary.to_csv()?)?;
            names.push(repeats_csv::FILE.to_owned());
        }
        let recorded = self.recorded.as_ref();
        let html = report::html(&self.manifest, &self.table, &sweeps, &drawings, recorded);
        file::write(&out.join("report.html"), html.as_bytes())?;
        names.push("report.html".to_owned());
        Ok(names)
    }

    /// The table for a terminal.
    pub fn text(&self) -> String {
        let sweeps = self.sweeps();
        let base = self.speed_up_base().into();
        let note = without_time::note(&self.manifest);
        let note = note.map_or(String::new(), |note| format!("\n{note}\n"));
        table_text(&self.table, &sweeps, base) + &cheapest::text(&self.table, &sweeps) + &note
    }

    /// How many runs failed.
    pub fn failures(&self) -> usize {
        self.table.rows.iter().filter(|row| self.table.cell(row, "ending") == "failed").count()
    }

    /// Names of the swept fields.
    pub fn sweeps(&self) -> Vec<String> {
        let names = self.manifest["sweeps"].as_array().into_iter().flatten();
        names.filter_map(|name| Some(name.as_str()?.to_owned())).collect()
    }

    /// The number of processors that speed-ups are over.
    fn speed_up_base(&self) -> u32 {
        let base = self.manifest["experiment"]["speed_up_over"].as_u64();
        base.and_then(|base| u32::try_from(base).ok()).filter(|base| *base > 0).unwrap_or(1)
    }

    fn plots(&self) -> Vec<Plot> {
        // Validated when the plan was made, or when the manifest was read.
        serde_json::from_value(self.manifest["experiment"]["plots"].clone()).unwrap_or_default()
    }
}

/// The files of the figures of the results with this manifest, and of their numbers; none if it cannot be read.
fn figures(manifest: &Path) -> Vec<String> {
    let Ok(document) = Document::read(manifest) else { return Vec::new() };
    let mut plots = read::<Vec<Plot>>(&document.value["experiment"]["plots"]).unwrap_or_default();
    plots.retain(|plot| is_plain(&plot.stem()));
    figures_of(&plots).collect()
}

/// The files of these plots, and of their numbers.
pub fn figures_of(plots: &[Plot]) -> impl Iterator<Item = String> {
    let repeats = plots.iter().any(|plot| plot.over.is_some());
    plots.iter().map(Plot::file_name).chain(repeats.then(|| repeats_csv::FILE.to_owned()))
}

/// Provenance of the results: everything that decides them, and nothing of the host.
fn manifest(plan: &Plan, table: &Table, on: On) -> io::Result<Value> {
    let problems = plan.problems.iter().map(|prepared| {
        let mut problem = json!(prepared.settings);
        problem["patches"] = prepared.problem.patches().into();
        problem
    });
    let files: Map<String, Value> =
        plan.files.iter().map(|file| (file.label.clone(), file.sha256.clone().into())).collect();
    let sweeps: Vec<String> = plan.axes.iter().map(|axis| axis.place.to_string()).collect();
    let mut manifest = json!({
        "title": plan.title,
        "virtwall": env!("CARGO_PKG_VERSION"),
        "on": on,
        "seed": plan.resolved["seed"],
        "runs": table.rows.len(),
        "runs_csv_sha256": sha256(&table.to_csv()?),
        "sweeps": sweeps,
        "experiment": plan.resolved,
        "problems": problems.collect::<Vec<Value>>(),
        "files": files,
        "warnings": plan.warnings,
    });
    let found = plan.settings_found();
    if !found.is_empty() {
        manifest["settings_found"] = found.into();
    }
    Ok(manifest)
}

/// Writes host times and what made the results, in a file of their own: results do not depend on them.
pub fn write_host_times(
    out: &Path,
    endings: &Endings,
    seconds: f64,
    threads: usize,
    provenance: &Value,
) -> io::Result<()> {
    let shots = json!({
        "asked": endings.shots.asked(),
        "found_in_memory": endings.shots.in_memory,
        "found_on_disk": endings.shots.archived,
        "cast": endings.shots.cast,
        "cast_in_vain": endings.shots.in_vain,
        "most_bytes_in_memory": endings.shot_bytes,
    });
    let of_runs = |times: &dyn Fn(&HostTimes) -> f64| -> Value {
        endings.host.iter().map(|run| run.as_ref().map(times)).collect()
    };
    let runs = json!({
        "cpu_s": of_runs(&|run| run.cpu_s),
        "set_up_s": of_runs(&|run| run.set_up_s),
        "clock_s": of_runs(&|run| run.clock_s),
    });
    let times = json!({
        "provenance": provenance, "threads": threads, "seconds": seconds, "shots": shots, "runs": runs,
    });
    file::make_folder(out)?;
    file::write(&out.join(host_times::FILE), pretty(&times)?.as_bytes())
}

fn pretty(value: &Value) -> io::Result<String> {
    Ok(serde_json::to_string_pretty(value)? + "\n")
}
