//! Why a plot, or a panel of one, shows nothing.

use crate::experiment::plot::Plot;
use crate::results::host_times;
use crate::table::columns::HOST;
use crate::table::measure::Measure;
use crate::table::runs_csv::Table;

/// Why none of these rows makes a point of a plot. `numeric` says whether x is a number, not a name.
pub fn why(table: &Table, rows: &[&Vec<String>], plot: &Plot, numeric: bool) -> String {
    let runs = rows.len();
    let failed = rows.iter().filter(|row| table.cell(row, "ending") == "failed").count();
    if runs == 0 {
        return "There are no runs.".to_owned();
    }
    if failed == runs {
        return if runs == 1 {
            "The run failed.".to_owned()
        } else {
            format!("All {runs} runs failed.")
        };
    }
    let value = |text: &str, row: &Vec<String>| Measure::of(text).value(table, row);
    let has_x = |row: &Vec<String>| !numeric || value(&plot.x, row).is_some();
    let has_y = |row: &Vec<String>| value(&plot.y, row).is_some();
    let any = |has: &dyn Fn(&Vec<String>) -> bool| rows.iter().any(|row| has(row));
    let (x, y) = (&plot.x, &plot.y);
    let mut why = if !any(&has_x) {
        no_number(x)
    } else if !any(&has_y) {
        no_number(y)
    } else if !any(&|row| has_x(row) && has_y(row)) {
        format!("No run has both {x} and {y}.")
    } else {
        "No point is above zero, as a logarithmic axis needs.".to_owned()
    };
    if failed > 0 {
        why += &format!(" {failed} of {runs} runs failed.");
    }
    why
}

fn no_number(column: &str) -> String {
    let host = if column.contains(HOST) {
        format!(" {} is not here.", host_times::FILE)
    } else {
        String::new()
    };
    format!("No run has a number as {column}.{host}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reason_is_named() {
        let own = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect::<Vec<_>>();
        let columns = own(&["processors", "time_s", "error_l2", "ending"]);
        let why_of = |rows: &[[&str; 4]], plot: &str| {
            let rows: Vec<Vec<String>> = rows.iter().map(|row| own(row)).collect();
            let table = Table { columns: columns.clone(), rows };
            let plot = serde_json::from_str(plot).unwrap();
            why(&table, &table.rows.iter().collect::<Vec<_>>(), &plot, true)
        };
        let plot = r#"{"x": "time_s", "y": "error_l2", "log_y": true}"#;
        let failed = ["1", "", "", "failed"];
        for (rows, reason) in [
            (&[][..], "There are no runs."),
            (&[failed], "The run failed."),
            (&[failed, failed], "All 2 runs failed."),
            (
                &[["1", "", "3", "agreed"], failed],
                "No run has a number as time_s. 1 of 2 runs failed.",
            ),
            (&[["1", "2", "", "agreed"]], "No run has a number as error_l2."),
            (
                &[["1", "2", "", "agreed"], ["1", "", "3", "agreed"]],
                "No run has both time_s and error_l2.",
            ),
            (&[["1", "2", "0", "agreed"]], "No point is above zero, as a logarithmic axis needs."),
        ] {
            assert_eq!(why_of(rows, plot), reason);
        }
        let host =
            why_of(&[["1", "2", "3", "agreed"]], r#"{"x": "processors", "y": "host.cpu_s"}"#);
        assert_eq!(host, "No run has a number as host.cpu_s. host-times.json is not here.");
    }
}
