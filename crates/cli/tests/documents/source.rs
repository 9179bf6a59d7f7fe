//! Files that claims are computed from: results as CSV with the host's times beside them, or one JSON file.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// A row: the text of each column.
pub type Row = BTreeMap<String, String>;

/// The files that have been read.
pub struct Sources {
    root: PathBuf,
    read: BTreeMap<String, Vec<Row>>,
}

impl Sources {
    /// Reads files below `root`.
    pub fn new(root: PathBuf) -> Self {
        Self { root, read: BTreeMap::new() }
    }

    /// All rows of a file; a JSON file is one row, whose columns are paths such as `network.model`.
    pub fn rows(&mut self, file: &str) -> Result<&[Row], String> {
        if !self.read.contains_key(file) {
            let path = self.root.join(file);
            let rows = match file.ends_with(".json") {
                true => vec![json(&path)?],
                false => csv(&path)?,
            };
            self.read.insert(file.to_owned(), rows);
        }
        Ok(&self.read[file])
    }
}

/// Rows of runs.csv. Single counts are columns too, such as `operations.ray`, and so are the host's
/// times, such as `host.cpu_s`.
fn csv(path: &Path) -> Result<Vec<Row>, String> {
    let message = |error: csv::Error| format!("{}: {error}", path.display());
    let mut rows: Vec<Row> = csv::Reader::from_path(path)
        .map_err(message)?
        .deserialize()
        .collect::<Result<_, _>>()
        .map_err(message)?;
    for row in &mut rows {
        let counts = row.get("operations").cloned().unwrap_or_default();
        let counts = counts.split(' ').filter_map(|count| count.split_once('='));
        row.extend(counts.map(|(name, n)| (format!("operations.{name}"), n.to_owned())));
    }
    let times = path.with_file_name("host-times.json");
    if times.exists() {
        let times: Value =
            serde_json::from_str(&text(&times)?).map_err(|error| error.to_string())?;
        for (name, values) in times["runs"].as_object().ok_or("no runs in host-times.json")? {
            for (row, value) in rows.iter_mut().zip(values.as_array().ok_or("no list")?) {
                row.insert(format!("host.{name}"), value.to_string());
            }
        }
    }
    Ok(rows)
}

/// A JSON file over the one that it extends.
fn json(path: &Path) -> Result<Row, String> {
    let value: Value = serde_json::from_str(&text(path)?).map_err(|error| error.to_string())?;
    let mut row = match value.get("extends").and_then(Value::as_str) {
        Some(base) => json(&path.with_file_name(format!("{base}.json")))?,
        None => Row::new(),
    };
    flatten("", &value, &mut row);
    Ok(row)
}

fn flatten(place: &str, value: &Value, row: &mut Row) {
    match value {
        Value::Object(fields) => {
            for (name, field) in fields {
                flatten(format!("{place}.{name}").trim_start_matches('.'), field, row);
            }
        }
        Value::Null => row.retain(|name, _| !name.starts_with(place)),
        Value::String(text) => drop(row.insert(place.to_owned(), text.clone())),
        other => drop(row.insert(place.to_owned(), other.to_string())),
    }
}

fn text(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}
