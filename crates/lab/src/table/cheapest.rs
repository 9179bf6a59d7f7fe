//! What accuracy costs: for each scene the setting that reaches an error in the least time.

use config::read_bytes;
use std::path::Path;

use crate::files::digest::FileDigest;
use crate::files::find::named_from;
use crate::table::runs_csv::Table;

/// Errors for which the cheapest setting is shown.
const TARGETS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

/// The cheapest run of a scene that reaches an error.
pub struct Cheapest {
    pub scene: String,
    /// The error to be reached, relative L2.
    pub target: f64,
    /// What it took; none if no run reaches the error.
    pub found: Option<Found>,
}

pub struct Found {
    pub time_s: f64,
    pub error: f64,
    pub setting: String,
}

/// For each scene and each error the cheapest run; nothing unless runs of a scene differ in their
/// errors.
pub fn cheapest(table: &Table, sweeps: &[String]) -> Vec<Cheapest> {
    let mut scenes = Vec::new();
    for row in &table.rows {
        let scene = table.cell(row, "scene");
        if !scenes.contains(&scene) {
            scenes.push(scene);
        }
    }
    let swept = sweeps.iter().any(|name| name != "scene");
    if !swept || !table.rows.iter().any(|row| table.number(row, "error_l2").is_some()) {
        return Vec::new();
    }
    let of = |scene: &&str| TARGETS.map(|target| reached(table, sweeps, scene, target));
    scenes.iter().flat_map(of).collect()
}

/// Reads the runs.csv of a sweep, at a path relative to `folder`.
pub fn read_sweep(folder: &Path, name: &str) -> Result<(Table, FileDigest), String> {
    let path = named_from(folder, name)?;
    let bytes = read_bytes(&path).map_err(|fault| fault.to_string())?;
    let table = Table::from_csv(&bytes)
        .map_err(|error| format!("\"{name}\": {error}; expected a runs.csv"))?;
    for column in ["scene", "time_s", "error_l2"] {
        if !table.columns.iter().any(|known| known == column) {
            return Err(format!("\"{name}\" has no column \"{column}\"; expected one"));
        }
    }
    Ok((table, FileDigest::of(&bytes, name)))
}

/// The least time of a run of a scene that reaches an error, s.
pub fn least_time(table: &Table, scene: &str, target: f64) -> Option<f64> {
    reached(table, &[], scene, target).found.map(|found| found.time_s)
}

fn reached(table: &Table, sweeps: &[String], scene: &str, target: f64) -> Cheapest {
    let runs =
        table.rows.iter().filter(|row| table.cell(row, "scene") == scene).filter_map(|row| {
            let (time, error) = (table.number(row, "time_s")?, table.number(row, "error_l2")?);
            (error <= target).then_some((time, error, row))
        });
    let best = runs.min_by(|a, b| a.0.total_cmp(&b.0));
    let found = best.map(|(time_s, error, row)| {
        let others = sweeps.iter().filter(|name| *name != "scene");
        let cells = others.map(|name| format!("{name} {}", table.cell(row, name)));
        Found { time_s, error, setting: cells.collect::<Vec<_>>().join(", ") }
    });
    Cheapest { scene: scene.to_owned(), target, found }
}

impl Cheapest {
    /// As cells: scene, target, time, error, setting.
    pub fn cells(&self) -> [String; 5] {
        let percent = |share: f64| format!("{} %", (share * 1e6).round() / 1e4);
        let (scene, target) = (self.scene.clone(), percent(self.target));
        match &self.found {
            None => [scene, target, "–".to_owned(), String::new(), "not reached".to_owned()],
            Some(Found { time_s, error, setting }) => {
                [scene, target, format!("{time_s:.2}"), percent(*error), setting.clone()]
            }
        }
    }
}

/// The table for a terminal; empty if it has no rows.
pub fn text(table: &Table, sweeps: &[String]) -> String {
    let cheapest = cheapest(table, sweeps);
    if cheapest.is_empty() {
        return String::new();
    }
    let line = |cells: [&str; 5]| {
        let [scene, target, time, error, setting] = cells;
        format!("{scene:<12}{target:>8}{time:>12}{error:>12}  {setting}\n")
    };
    let head = line(["scene", "error", "time s", "found", "cheapest setting"]);
    let lines = cheapest.iter().map(|c| line(c.cells().each_ref().map(String::as_str)));
    lines.fold(format!("\n{head}"), |text, line| text + &line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cheapest_setting_below_the_error_is_reported() {
        let own = |cells: [&str; 4]| cells.map(str::to_owned).to_vec();
        let rows = [
            ["a", "64", "1", "0.2"],
            ["a", "256", "2", "0.02"],
            ["a", "512", "4", "0.001"],
            ["b", "64", "1", "0.05"],
            ["b", "256", "", ""],
        ];
        let columns = own(["scene", "pixels", "time_s", "error_l2"]);
        let table = Table { columns, rows: rows.map(own).to_vec() };
        let sweeps = ["scene", "pixels"].map(str::to_owned);
        let found = cheapest(&table, &sweeps);
        let times: Vec<_> =
            found.iter().map(|c| c.found.as_ref().map(|found| found.time_s)).collect();
        let expected = [Some(2.0), Some(2.0), Some(4.0), Some(4.0), Some(1.0), None, None, None];
        assert_eq!(times, expected);
        assert_eq!(found[1].cells(), ["a", "3 %", "2.00", "2 %", "pixels 256"]);
        assert!(cheapest(&table, &sweeps[..1]).is_empty());
    }
}
