//! Published figures, to compare results with.

use std::collections::BTreeMap;
use std::path::Path;

use config::Fault;

/// Published times and speed-ups, as the file writes them, by scene and processors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison(BTreeMap<(String, u32), Published>);

/// What was published for one scene and number of processors; empty where nothing was.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Published {
    pub time_s: String,
    pub speed_up: String,
}

/// The columns that the file must have.
const COLUMNS: [&str; 4] = ["scene", "processors", "time_s", "speed_up"];

impl Comparison {
    /// Reads a CSV file with the columns scene, processors, time_s and speed_up.
    ///
    /// # Errors
    /// If a column is missing, or a cell is no number. `path` names the file.
    pub fn read(bytes: &[u8], path: &Path) -> Result<Comparison, Fault> {
        parse(bytes).map_err(|(line, message)| {
            let line = line.map(|line| line as usize);
            Fault { line, ..Fault::of_file(path.display(), message) }
        })
    }

    pub fn of(&self, scene: &str, processors: u32) -> Published {
        self.0.get(&(scene.to_owned(), processors)).cloned().unwrap_or_default()
    }
}

/// An error in the file: its line, counted from 1, if known, and what is wrong there.
type Wrong = (Option<u64>, String);

fn parse(text: &[u8]) -> Result<Comparison, Wrong> {
    let damaged = |error: csv::Error| (error.position().map(|p| p.line()), error.to_string());
    let mut reader = csv::Reader::from_reader(text);
    let columns = find_columns(reader.headers().map_err(damaged)?)?;
    let mut published = BTreeMap::new();
    for record in reader.records() {
        let record = record.map_err(damaged)?;
        let refuse = |message| Err((record.position().map(|p| p.line()), message));
        let [scene, processors, time_s, speed_up] =
            columns.map(|column| record.get(column).unwrap_or_default().trim());
        let Ok(processors) = processors.parse() else {
            return refuse(format!("processors \"{processors}\"; expected a whole number"));
        };
        for (name, cell) in [("time_s", time_s), ("speed_up", speed_up)] {
            let number = cell.parse().is_ok_and(|n: f64| n.is_finite() && n > 0.0);
            if !cell.is_empty() && !number {
                return refuse(format!("{name} \"{cell}\"; expected a number above 0, or nothing"));
            }
        }
        let cells = Published { time_s: time_s.to_owned(), speed_up: speed_up.to_owned() };
        if published.insert((scene.to_owned(), processors), cells).is_some() {
            return refuse(format!("{scene} on {processors} processors; expected each once"));
        }
    }
    Ok(Comparison(published))
}

fn find_columns(header: &csv::StringRecord) -> Result<[usize; 4], Wrong> {
    let mut found = [0; 4];
    for (found, name) in found.iter_mut().zip(COLUMNS) {
        *found = header.iter().position(|cell| cell == name).ok_or_else(|| {
            let expected = COLUMNS.join(", ");
            (Some(1), format!("no column \"{name}\"; expected {expected}"))
        })?;
    }
    Ok(found)
}
