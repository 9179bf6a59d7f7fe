//! The operations of all runs, one row a run and operation: what runs.csv has in one cell.

use crate::table::columns::OPERATIONS;
use crate::table::runs_csv::Table;

/// The file in a folder of results.
pub const FILE: &str = "operations.csv";

/// A row for each run and operation: the run's row in runs.csv, from 1, its scene, its processors and the
/// other swept fields, the operation and its count.
pub fn operations(runs: &Table, sweeps: &[String]) -> Table {
    let swept = sweeps.iter().map(String::as_str);
    let others = swept.filter(|field| !["scene", "processors"].contains(field));
    let fields: Vec<&str> = ["scene", "processors"].into_iter().chain(others).collect();
    let columns = ["run"].iter().chain(&fields).chain(&["operation", "count"]);
    let mut table =
        Table { columns: columns.map(|name| (*name).to_owned()).collect(), rows: Vec::new() };
    for (number, run) in (1..).zip(&runs.rows) {
        let cells = fields.iter().map(|field| runs.cell(run, field).to_owned());
        let of_run: Vec<String> = [format!("{number}")].into_iter().chain(cells).collect();
        let counts = runs.cell(run, OPERATIONS[0]).split(' ');
        for (name, count) in counts.filter_map(|count| count.split_once('=')) {
            table.rows.push([&of_run[..], &[name.to_owned(), count.to_owned()]].concat());
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_count_is_a_row() {
        let own = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect::<Vec<_>>();
        let columns = own(&["scene", "processors", "ties", "operations"]);
        let rows = vec![own(&["a", "1", "local", "ray=3 hit=2"]), own(&["a", "2", "local", ""])];
        let table = operations(&Table { columns, rows }, &own(&["processors", "ties"]));
        assert_eq!(table.columns, ["run", "scene", "processors", "ties", "operation", "count"]);
        let expected = [["1", "a", "1", "local", "ray", "3"], ["1", "a", "1", "local", "hit", "2"]];
        assert_eq!(table.rows, expected);
    }
}
