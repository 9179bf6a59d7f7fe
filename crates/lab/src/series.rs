//! What a plot shows: points of simulated and published figures, line by line.

use crate::experiment::Plot;
use crate::table::Table;

/// One line of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name; empty if there is only one line.
    pub name: String,
    /// Simulated points, by x.
    pub simulated: Vec<(f64, f64)>,
    /// Published points, by x.
    pub paper: Vec<(f64, f64)>,
}

/// All that a plot shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Its lines, in the order of the results.
    pub series: Vec<Series>,
    /// Names along the horizontal axis, at 0, 1, 2, ..., if its column holds no numbers.
    pub categories: Vec<String>,
    /// Unit along the horizontal axis; empty if there is none.
    pub unit: String,
}

impl Drawing {
    /// What `plot` shows of the results; every field of `sweeps` that is neither x nor the
    /// series makes lines of its own.
    pub fn of(table: &Table, sweeps: &[String], plot: &Plot) -> Drawing {
        let unit = common_unit(table, &plot.x);
        let numeric = unit.is_some();
        let unit = unit.unwrap_or_default().to_owned();
        let mut drawing = Drawing { series: Vec::new(), categories: Vec::new(), unit };
        let paper = format!("paper_{}", plot.y);
        for row in &table.rows {
            let x = if numeric {
                table.number(row, &plot.x).unwrap_or_default()
            } else {
                position(&mut drawing.categories, table.cell(row, &plot.x)) as f64
            };
            let name = name(table, row, sweeps, plot);
            let series = line(&mut drawing.series, name);
            series.simulated.extend(table.number(row, &plot.y).map(|y| (x, y)));
            series.paper.extend(table.number(row, &paper).map(|y| (x, y)));
        }
        // A logarithm has no place for zero or less.
        let fits = |(x, y): &(f64, f64)| (!plot.log_x || *x > 0.0) && (!plot.log_y || *y > 0.0);
        for series in &mut drawing.series {
            for points in [&mut series.simulated, &mut series.paper] {
                points.retain(fits);
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
            }
        }
        drawing
    }

    /// All points.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.series.iter().flat_map(|s| s.simulated.iter().chain(&s.paper).copied())
    }
}

/// The unit of all cells of a column; `None` if they have not the same, or are no numbers.
fn common_unit<'a>(table: &'a Table, column: &str) -> Option<&'a str> {
    let mut units = table.rows.iter().map(|row| table.quantity(row, column).map(|(_, unit)| unit));
    let first = units.next()??;
    units.all(|unit| unit == Some(first)).then_some(first)
}

/// The name of a row's line: its series, and what is swept besides.
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

/// The line of that name, begun if need be.
fn line(series: &mut Vec<Series>, name: String) -> &mut Series {
    let index = series.iter().position(|line| line.name == name).unwrap_or(series.len());
    if index == series.len() {
        series.push(Series { name, simulated: Vec::new(), paper: Vec::new() });
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
    fn other_cells_stand_side_by_side() {
        let rows = [["a", "0.3 m", "5"], ["b", "30 cm", "4"]];
        let by_size = drawing(&rows, r#"{"x": "size", "y": "time_s"}"#);
        assert_eq!(by_size.categories, ["0.3 m", "30 cm"]);
        let by_scene = drawing(&rows, r#"{"x": "scene", "y": "time_s", "series": "size"}"#);
        assert_eq!((by_scene.categories.len(), by_scene.unit.as_str()), (2, ""));
    }
}
