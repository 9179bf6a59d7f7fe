//! Host times of each run, read again to be drawn. They are in a file of their own: results do not depend on
//! them.

use std::path::Path;

use config::Document;
use serde_json::Value;

use crate::experiment::plot::Plot;
use crate::table::columns::{HOST, HOST_TIMES};
use crate::table::runs_csv::Table;

/// The file in a folder of results.
pub const FILE: &str = "host-times.json";

/// The results with columns of host times, which are empty where `folder` does not have them.
pub fn beside(table: &Table, folder: &Path) -> Table {
    let times = Document::read(&folder.join(FILE)).map_or(Value::Null, |file| file.value);
    let mut table = table.clone();
    for (name, _) in HOST_TIMES {
        table.columns.push(HOST.to_owned() + name);
        let of_runs = times["runs"][name].as_array().filter(|runs| runs.len() == table.rows.len());
        for (run, row) in table.rows.iter_mut().enumerate() {
            let time = of_runs.and_then(|runs| runs[run].as_f64());
            row.push(time.map_or(String::new(), |seconds| seconds.to_string()));
        }
    }
    table
}

/// Whether a plot shows host times, which differ each time.
pub fn shown_in(plot: &Plot) -> bool {
    [&plot.x, &plot.y].iter().any(|text| text.contains(HOST))
}
