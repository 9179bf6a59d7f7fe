//! Published figures to stand beside ours.

use std::collections::BTreeMap;
use std::path::Path;

use crate::fault::Fault;

/// Published times and speed-ups, as the file writes them, by scene and processors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison(BTreeMap<(String, u32), Published>);

/// What was published for one scene and number of processors; empty where nothing was.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Published {
    /// Seconds.
    pub time_s: String,
    /// Speed-up over one processor.
    pub speed_up: String,
}

/// The columns that the file must have.
const COLUMNS: [&str; 4] = ["scene", "processors", "time_s", "speed_up"];

impl Comparison {
    /// Reads a CSV file with the columns scene, processors, time_s and speed_up.
    ///
    /// # Errors
    /// If it cannot be read, a column is missing, or a cell is no number.
    pub fn read(path: &Path) -> Result<Comparison, Fault> {
        let file = &path.display();
        let refuse = |line, message| {
            Err(Fault { file: file.to_string(), line, place: Default::default(), message })
        };
        let text = std::fs::read(path)
            .map_err(|error| Fault::of_file(file, format!("cannot be read: {error}")))?;
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let header = match reader.headers() {
            Ok(header) => header.clone(),
            Err(error) => return refuse(None, error.to_string()),
        };
        let mut columns = [0; 4];
        for (column, name) in columns.iter_mut().zip(COLUMNS) {
            match header.iter().position(|cell| cell == name) {
                Some(found) => *column = found,
                None => return refuse(Some(1), format!("no column \"{name}\"; expected {COLUMNS:?}")),
            }
        }
        let mut published = BTreeMap::new();
        for record in reader.records() {
            let record = match record {
                Ok(record) => record,
                Err(error) => return refuse(None, error.to_string()),
            };
            let line = record.position().map(|position| position.line() as usize);
            let [scene, processors, time_s, speed_up] =
                columns.map(|column| record.get(column).unwrap_or_default().trim());
            let Ok(processors) = processors.parse() else {
                let message = format!("processors \"{processors}\"; expected a whole number");
                return refuse(line, message);
            };
            for (name, cell) in [("time_s", time_s), ("speed_up", speed_up)] {
                let number = cell.parse().is_ok_and(|n: f64| n.is_finite() && n > 0.0);
                if !cell.is_empty() && !number {
                    let message = format!("{name} \"{cell}\"; expected a number above 0, or nothing");
                    return refuse(line, message);
                }
            }
            let cells = Published { time_s: time_s.to_owned(), speed_up: speed_up.to_owned() };
            if published.insert((scene.to_owned(), processors), cells).is_some() {
                let message = format!("{scene} on {processors} processors a second time");
                return refuse(line, message);
            }
        }
        Ok(Comparison(published))
    }

    /// What was published for a scene and a number of processors.
    pub fn of(&self, scene: &str, processors: u32) -> Published {
        self.0.get(&(scene.to_owned(), processors)).cloned().unwrap_or_default()
    }
}
