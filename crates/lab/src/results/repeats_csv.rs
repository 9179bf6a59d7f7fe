//! summary.csv: mean and spread of the repeats that plots show.

use crate::experiment::plot::Plot;
use crate::results::repeats::Repeats;
use crate::results::series::{Drawing, Series};
use crate::table::runs_csv::Table;

/// The file in a folder of results.
pub const FILE: &str = "summary.csv";

const COLUMNS: [&str; 12] = [
    "plot",
    "panel",
    "line",
    "x",
    "at",
    "y",
    "over",
    "count",
    "mean",
    "standard_deviation",
    "quantile_5",
    "quantile_95",
];

/// A row for each x of each line of the plots with repeats; none if no plot has any.
pub fn summary(table: &Table, sweeps: &[String], plots: &[Plot]) -> Option<Table> {
    let repeated = plots.iter().filter(|plot| plot.over.is_some());
    let rows: Vec<Vec<String>> = repeated.flat_map(|plot| rows(table, sweeps, plot)).collect();
    let columns = COLUMNS.map(str::to_owned).to_vec();
    plots.iter().any(|plot| plot.over.is_some()).then_some(Table { columns, rows })
}

fn rows(table: &Table, sweeps: &[String], plot: &Plot) -> Vec<Vec<String>> {
    // What axes have no place for counts here.
    let all = Plot { log_x: false, log_y: false, power_law: false, pareto: false, ..plot.clone() };
    let drawing = Drawing::of(table, sweeps, &all);
    let over = plot.over.as_deref().unwrap_or_default();
    let mut rows = Vec::new();
    for panel in &drawing.panels {
        for series in &panel.series {
            let points = |Series { repeats, .. }: &Series| repeats.clone();
            for (x, repeats) in points(series) {
                let at = place(&drawing, x);
                let line = &drawing.names[series.line];
                let names = [&plot.stem(), &panel.name, line, &plot.x, &at, &plot.y, over];
                rows.push(names.map(str::to_owned).into_iter().chain(numbers(repeats)).collect());
            }
        }
    }
    rows
}

/// An x as in runs.csv.
fn place(drawing: &Drawing, x: f64) -> String {
    let category = drawing.categories.get(x as usize).cloned();
    category.unwrap_or_else(|| format!("{x} {}", drawing.units[0]).trim_end().to_owned())
}

fn numbers(repeats: Repeats) -> [String; 5] {
    let Repeats { count, mean, deviation, low, high } = repeats;
    let deviation = deviation.map_or(String::new(), |deviation| deviation.to_string());
    [count.to_string(), mean.to_string(), deviation, low.to_string(), high.to_string()]
}

#[cfg(test)]
mod tests {
    use super::*;

    const RUNS: &str = "\
scene,processors,seed,size,time_s
box,1,1,4 MiB,8
box,1,2,4 MiB,10
box,1,3,4 MiB,12
box,2,1,4 MiB,5
box,2,2,4 MiB,
box,2,3,4 MiB,4
hall,1,1,4 MiB,-1
";

    #[test]
    fn mean_spread_and_count_of_each_y_at_each_x() {
        let table = Table::from_csv(RUNS.as_bytes()).unwrap();
        let sweeps = ["scene", "processors", "seed"].map(str::to_owned);
        let plots = r#"[
            { "x": "processors", "y": "time_s", "over": "seed", "log_y": true, "power_law": true },
            { "x": "processors", "y": "time_s" },
            { "x": "scene", "y": "time_s", "over": "seed", "facet": "processors", "file": "b" }
        ]"#;
        let plots: Vec<Plot> = serde_json::from_str(plots).unwrap();
        assert_eq!(summary(&table, &sweeps, &plots[1..2]), None);
        let summary = summary(&table, &sweeps, &plots).unwrap().to_csv().unwrap();
        let expected = "\
plot,panel,line,x,at,y,over,count,mean,standard_deviation,quantile_5,quantile_95
time_s-by-processors,,box,processors,1,time_s,seed,3,10,2,8.2,11.8
time_s-by-processors,,box,processors,2,time_s,seed,2,4.5,0.7071067811865476,4.05,4.95
time_s-by-processors,,hall,processors,1,time_s,seed,1,-1,,-1,-1
b,processors 1,,scene,box,time_s,seed,3,10,2,8.2,11.8
b,processors 1,,scene,hall,time_s,seed,1,-1,,-1,-1
b,processors 2,,scene,box,time_s,seed,2,4.5,0.7071067811865476,4.05,4.95
";
        assert_eq!(String::from_utf8(summary).unwrap(), expected);
    }
}
