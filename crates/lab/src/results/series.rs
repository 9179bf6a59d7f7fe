//! What a plot shows: points of simulated and published figures, line by line.

use crate::experiment::fields::Plot;
use crate::experiment::sweep::in_words;
use crate::results::pareto;
use crate::results::power_law::PowerLaw;
use crate::table::measure::Measure;
use crate::table::runs_csv::Table;

/// One line of a plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Its name, with the law's exponent; empty if there is only one line without a law.
    pub name: String,
    /// Simulated points, by x.
    pub simulated: Vec<(f64, f64)>,
    /// Published points, by x.
    pub paper: Vec<(f64, f64)>,
    /// Those of the simulated points that are to be marked.
    pub marked: Vec<(f64, f64)>,
    /// Those that no other betters, if only they are to be joined.
    pub front: Option<Vec<(f64, f64)>>,
    /// The law to draw through the simulated points, if one is asked for and there is one.
    pub law: Option<PowerLaw>,
}

/// All that a plot shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    pub series: Vec<Series>,
    /// Names along the horizontal axis, at 0, 1, 2, ..., if its column holds no numbers.
    pub categories: Vec<String>,
    /// Unit of the cells along the horizontal axis; empty if there is none.
    pub unit: String,
    /// The same of the vertical axis.
    pub unit_up: String,
    /// Whether x is a swept field and not a figure of the runs.
    pub swept: bool,
    /// What the published points are called: the prefix of their column.
    pub publisher: &'static str,
}

impl Drawing {
    /// What `plot` shows of the results; where x is one of the swept fields `sweeps`, each of them
    /// that is neither x nor the series makes lines of its own.
    pub fn of(table: &Table, sweeps: &[String], plot: &Plot) -> Drawing {
        let swept = sweeps.contains(&plot.x);
        let (along, up) = (Measure::of(&plot.x), Measure::of(&plot.y));
        let unit = along.unit(table);
        let numeric = unit.is_some();
        let unit = unit.unwrap_or_default().to_owned();
        let unit_up = up.unit(table).unwrap_or_default().to_owned();
        let known = |publisher| table.columns.contains(&format!("{publisher}_{}", plot.y));
        let publisher = if known("published") { "published" } else { "paper" };
        let (series, categories) = (Vec::new(), Vec::new());
        let mut drawing = Drawing { series, categories, unit, unit_up, swept, publisher };
        let paper = format!("{publisher}_{}", plot.y);
        for row in &table.rows {
            let x = if numeric {
                along.value(table, row)
            } else {
                Some(position(&mut drawing.categories, table.cell(row, &plot.x)) as f64)
            };
            // A run that failed has no figures.
            let Some(x) = x else { continue };
            let besides = if swept { sweeps } else { &[] };
            let name = name(table, row, besides, plot);
            let series = line(&mut drawing.series, name);
            let point = up.value(table, row).map(|y| (x, y));
            series.simulated.extend(point);
            series.marked.extend(point.filter(|_| marked(table, row, plot)));
            series.paper.extend(table.number(row, &paper).map(|y| (x, y)));
        }
        // A logarithm has no place for zero or less.
        let [log_x, log_y] = plot.logarithmic();
        let fits = |(x, y): &(f64, f64)| (!log_x || !numeric || *x > 0.0) && (!log_y || *y > 0.0);
        for series in &mut drawing.series {
            for points in [&mut series.simulated, &mut series.paper, &mut series.marked] {
                points.retain(fits);
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
            }
            if plot.power_law && numeric {
                series.add_law();
            }
            series.front = plot.pareto.then(|| pareto::front(&series.simulated));
        }
        drawing
    }

    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.series.iter().flat_map(|s| s.simulated.iter().chain(&s.paper).copied())
    }
}

impl Series {
    fn add_law(&mut self) {
        self.law = PowerLaw::fit(&self.simulated);
        if let Some(law) = self.law {
            let between = if self.name.is_empty() { "" } else { ": " };
            self.name += &(between.to_owned() + &law.words());
        }
    }
}

/// The name of a row's line: its series, and the values of other swept fields.
fn name(table: &Table, row: &[String], sweeps: &[String], plot: &Plot) -> String {
    let series = plot.series.iter();
    let others =
        sweeps.iter().filter(|name| **name != plot.x && Some(*name) != plot.series.as_ref());
    let cells = series.chain(others).map(|name| match table.cell(row, name) {
        "" => format!("{name} default"),
        // A bare number says nothing without its field.
        cell if cell.parse::<f64>().is_ok() => format!("{name} {cell}"),
        cell => cell.to_owned(),
    });
    cells.collect::<Vec<_>>().join(", ")
}

fn marked(table: &Table, row: &[String], plot: &Plot) -> bool {
    let same = |(name, value): (&String, _)| table.cell(row, name) == in_words(value);
    !plot.mark.is_empty() && plot.mark.iter().all(same)
}

/// The line of that name, begun if need be.
fn line(series: &mut Vec<Series>, name: String) -> &mut Series {
    let index = series.iter().position(|line| line.name == name).unwrap_or(series.len());
    if index == series.len() {
        series.push(Series { name, ..Series::default() });
    }
    &mut series[index]
}

fn position(names: &mut Vec<String>, name: &str) -> usize {
    names.iter().position(|known| known == name).unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(cells: &[[&str; 3]], plot: &str) -> Drawing {
        let own = |row: &[&str; 3]| row.map(str::to_owned).to_vec();
        let columns = own(&["scene", "size", "time_s"]);
        let table = Table { columns, rows: cells.iter().map(own).collect() };
        let plot = serde_json::from_str(plot).unwrap();
        Drawing::of(&table, &["scene".to_owned(), "size".to_owned()], &plot)
    }

    #[test]
    fn quantities_of_one_unit_make_an_axis_of_it() {
        let rows = [["a", "0.3 m", "5"], ["a", "0.1 m", "4"], ["b", "0.3 m", "-1"]];
        let drawing = drawing(&rows, r#"{"x": "size", "y": "time_s", "log_y": true}"#);
        assert_eq!(drawing.unit, "m");
        let points: Vec<_> =
            drawing.series.iter().map(|s| (s.name.as_str(), s.simulated.as_slice())).collect();
        assert_eq!(points, [("a", &[(0.1, 4.0), (0.3, 5.0)][..]), ("b", &[])]);
    }

    #[test]
    fn along_a_figure_of_the_runs_only_the_series_makes_lines() {
        let rows = [["a", "1 m", "2"], ["b", "1 m", "4"], ["a", "2 m", "3"], ["b", "2 m", ""]];
        let plot = r#"{"x": "time_s*time_s", "y": "time_s", "series": "size", "power_law": true}"#;
        let drawing = drawing(&rows, plot);
        let lines: Vec<_> =
            drawing.series.iter().map(|s| (s.name.as_str(), s.simulated.as_slice())).collect();
        let expected =
            [("1 m: exponent 0.50", &[(4.0, 2.0), (16.0, 4.0)][..]), ("2 m", &[(9.0, 3.0)])];
        assert_eq!(lines, expected);
    }

    #[test]
    fn other_cells_stand_side_by_side() {
        let rows = [["a", "0.3 m", "5"], ["b", "30 cm", "4"]];
        let by_size = drawing(&rows, r#"{"x": "size", "y": "time_s"}"#);
        assert_eq!(by_size.categories, ["0.3 m", "30 cm"]);
        let by_scene = drawing(&rows, r#"{"x": "scene", "y": "time_s", "series": "size"}"#);
        assert_eq!((by_scene.categories.len(), by_scene.unit.as_str()), (2, ""));
    }
}
