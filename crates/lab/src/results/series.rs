//! What a plot shows: points of simulated and published figures, line by line, panel by panel.

use crate::experiment::plot::Plot;
use crate::experiment::sweep::in_words;
use crate::results::empty;
use crate::results::pareto;
use crate::results::power_law::PowerLaw;
use crate::results::repeats::Repeats;
use crate::table::measure::Measure;
use crate::table::runs_csv::Table;

/// One line of a panel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Index into [`Drawing::names`], by which it has its style.
    pub line: usize,
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
    /// What repeats tell, by x, of which the simulated points are the means; empty without repeats.
    pub repeats: Vec<(f64, Repeats)>,
}

/// The lines of one value of the column that makes panels, or of all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// That value; empty if there is only one panel.
    pub name: String,
    pub series: Vec<Series>,
    /// Why there is no point, if there is none.
    pub empty: String,
}

/// All that a plot shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// One at least.
    pub panels: Vec<Panel>,
    /// Names of the lines: the same name is the same line in every panel. Empty if there is only one line.
    pub names: Vec<String>,
    /// Names along the horizontal axis, at 0, 1, 2, ..., if its column holds no numbers.
    pub categories: Vec<String>,
    /// Units of the cells along the horizontal and the vertical axis; empty if they have none.
    pub units: [String; 2],
    /// Whether x is a swept field and not a figure of the runs.
    pub swept: bool,
    /// What the published points are called: the prefix of their column.
    pub publisher: &'static str,
    /// Points left out, since a logarithm has no place for zero or less.
    pub left_out: usize,
}

impl Drawing {
    /// What `plot` shows of the results; where x is one of the swept fields `sweeps`, each of them
    /// that has no other part in the plot makes lines of its own.
    pub fn of(table: &Table, sweeps: &[String], plot: &Plot) -> Drawing {
        let swept = sweeps.contains(&plot.x);
        let [along, up] = [&plot.x, &plot.y].map(|text| Measure::of(text));
        let unit = along.unit(table);
        let numeric = unit.is_some();
        let units = [unit, up.unit(table)].map(|unit| unit.unwrap_or_default().to_owned());
        let known = |publisher| table.columns.contains(&format!("{publisher}_{}", plot.y));
        let publisher = if known("published") { "published" } else { "paper" };
        let mut drawing = Drawing {
            panels: Vec::new(),
            names: Vec::new(),
            categories: Vec::new(),
            units,
            swept,
            publisher,
            left_out: 0,
        };
        let paper = format!("{publisher}_{}", plot.y);
        let besides = if swept { sweeps } else { &[] };
        let mut rows_of: Vec<Vec<&Vec<String>>> = Vec::new();
        for row in &table.rows {
            let panel = drawing.panel(table, row, plot);
            rows_of.resize(drawing.panels.len(), Vec::new());
            rows_of[panel].push(row);
            let x = if numeric {
                along.value(table, row)
            } else {
                Some(position(&mut drawing.categories, table.cell(row, &plot.x)) as f64)
            };
            // A run that failed has no figures.
            let Some(x) = x else { continue };
            let series = drawing.series(panel, &name(table, row, besides, plot));
            let point = up.value(table, row).map(|y| (x, y));
            series.simulated.extend(point);
            series.marked.extend(point.filter(|_| marked(table, row, plot)));
            series.paper.extend(table.number(row, &paper).map(|y| (x, y)));
        }
        if drawing.panels.is_empty() {
            drawing.panels.push(Panel::default());
            rows_of.push(Vec::new());
        }
        for (panel, rows) in drawing.panels.iter_mut().zip(&rows_of) {
            for series in &mut panel.series {
                drawing.left_out += series.complete(plot, numeric);
            }
            if panel.points().next().is_none() {
                panel.empty = empty::why(table, rows, plot, numeric);
            }
        }
        drawing
    }

    /// All points, and the ends of the bands around them.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.panels.iter().flat_map(Panel::points)
    }

    pub fn is_empty(&self) -> bool {
        self.points().next().is_none()
    }

    pub fn series_of_all(&self) -> impl Iterator<Item = &Series> + Clone {
        self.panels.iter().flat_map(|panel| &panel.series)
    }

    /// The panel of a row, begun if need be.
    fn panel(&mut self, table: &Table, row: &[String], plot: &Plot) -> usize {
        let name = plot.facet.as_ref().map_or(String::new(), |facet| cell(table, row, facet));
        let known = self.panels.iter().position(|panel| panel.name == name);
        known.unwrap_or_else(|| {
            self.panels.push(Panel { name, ..Panel::default() });
            self.panels.len() - 1
        })
    }

    /// The line of that name in a panel, begun if need be.
    fn series(&mut self, panel: usize, name: &str) -> &mut Series {
        let line = position(&mut self.names, name);
        let series = &mut self.panels[panel].series;
        let index = series.iter().position(|s| s.line == line).unwrap_or(series.len());
        if index == series.len() {
            series.push(Series { line, ..Series::default() });
        }
        &mut series[index]
    }
}

impl Panel {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.series.iter().flat_map(|series| {
            let ends = |(x, repeats): &(f64, Repeats)| [(*x, repeats.low), (*x, repeats.high)];
            let bands = series.repeats.iter().flat_map(ends);
            series.simulated.iter().chain(&series.paper).copied().chain(bands)
        })
    }
}

impl Series {
    /// Sorts the points, and adds what is made from all of them; returns how many have no place on the axes.
    fn complete(&mut self, plot: &Plot, numeric: bool) -> usize {
        for points in [&mut self.simulated, &mut self.paper, &mut self.marked] {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        if plot.over.is_some() {
            self.gather();
        }
        // A logarithm has no place for zero or less.
        let [log_x, log_y] = plot.logarithmic();
        let fits = |(x, y): &(f64, f64)| (!log_x || !numeric || *x > 0.0) && (!log_y || *y > 0.0);
        let all = self.simulated.len();
        for points in [&mut self.simulated, &mut self.paper, &mut self.marked] {
            points.retain(fits);
        }
        self.repeats.retain(|(x, repeats)| fits(&(*x, repeats.mean)));
        if log_y {
            // A band goes down to where its mean is if it has no place below.
            let lowest =
                self.repeats.iter().map(|(_, repeats)| repeats.low).filter(|low| *low > 0.0);
            let lowest = lowest.fold(f64::MAX, f64::min);
            for (_, repeats) in self.repeats.iter_mut().filter(|(_, repeats)| repeats.low <= 0.0) {
                repeats.low = lowest.min(repeats.mean);
            }
        }
        if plot.power_law && numeric {
            self.law = PowerLaw::fit(&self.simulated);
        }
        self.front = plot.pareto.then(|| pareto::front(&self.simulated));
        all - self.simulated.len()
    }

    /// Puts the mean in place of the points of each x. A mean is marked if all its points are.
    fn gather(&mut self) {
        self.repeats = gathered(&self.simulated);
        let marked = gathered(&self.marked);
        let all = |(x, repeats): &&(f64, Repeats)| {
            marked.iter().any(|(at, marked)| at == x && marked.count == repeats.count)
        };
        let mean = |(x, repeats): &(f64, Repeats)| (*x, repeats.mean);
        self.marked = self.repeats.iter().filter(all).map(mean).collect();
        self.simulated = self.repeats.iter().map(mean).collect();
        self.paper = gathered(&self.paper).iter().map(mean).collect();
    }
}

/// The repeats at each x of points with rising x.
fn gathered(points: &[(f64, f64)]) -> Vec<(f64, Repeats)> {
    let groups = points.chunk_by(|a, b| a.0 == b.0);
    let repeats = groups.filter_map(|group| {
        let values: Vec<f64> = group.iter().map(|(_, y)| *y).collect();
        Some((group[0].0, Repeats::of(&values)?))
    });
    repeats.collect()
}

/// The name of a row's line: its series, and the values of other swept fields.
fn name(table: &Table, row: &[String], sweeps: &[String], plot: &Plot) -> String {
    let apart = [Some(&plot.x), plot.series.as_ref(), plot.facet.as_ref(), plot.over.as_ref()];
    let others = sweeps.iter().filter(|name| !apart.contains(&Some(*name)));
    let names = plot.series.iter().chain(others);
    names.map(|name| cell(table, row, name)).collect::<Vec<_>>().join(", ")
}

/// What a cell is called where its column is not named.
fn cell(table: &Table, row: &[String], name: &str) -> String {
    match table.cell(row, name) {
        "" => format!("{name} default"),
        // A bare number, or yes or no, says nothing without its field.
        cell if cell.parse::<f64>().is_ok() || cell.parse::<bool>().is_ok() => {
            format!("{name} {cell}")
        }
        cell => cell.to_owned(),
    }
}

fn marked(table: &Table, row: &[String], plot: &Plot) -> bool {
    let same = |(name, value): (&String, _)| table.cell(row, name) == in_words(value);
    !plot.mark.is_empty() && plot.mark.iter().all(same)
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

    /// Lines of a panel by name, and their points.
    fn lines(drawing: &Drawing, panel: usize) -> Vec<(&str, &[(f64, f64)])> {
        let series = drawing.panels[panel].series.iter();
        series.map(|s| (drawing.names[s.line].as_str(), s.simulated.as_slice())).collect()
    }

    #[test]
    fn quantities_of_one_unit_make_an_axis_of_it() {
        let rows = [["a", "0.3 m", "5"], ["a", "0.1 m", "4"], ["b", "0.3 m", "-1"]];
        let drawing = drawing(&rows, r#"{"x": "size", "y": "time_s", "log_y": true}"#);
        assert_eq!((drawing.units[0].as_str(), drawing.left_out), ("m", 1));
        assert_eq!(lines(&drawing, 0), [("a", &[(0.1, 4.0), (0.3, 5.0)][..]), ("b", &[])]);
    }

    #[test]
    fn along_a_figure_of_the_runs_only_the_series_makes_lines() {
        let rows = [["a", "1 m", "2"], ["b", "1 m", "4"], ["a", "2 m", "3"], ["b", "2 m", ""]];
        let plot = r#"{"x": "time_s*time_s", "y": "time_s", "series": "size", "power_law": true}"#;
        let drawing = drawing(&rows, plot);
        let expected = [("1 m", &[(4.0, 2.0), (16.0, 4.0)][..]), ("2 m", &[(9.0, 3.0)])];
        assert_eq!(lines(&drawing, 0), expected);
        assert_eq!(drawing.panels[0].series[0].law.unwrap().words(), "exponent 0.50");
        assert_eq!(drawing.panels[0].series[1].law, None);
    }

    #[test]
    fn other_cells_stand_side_by_side() {
        let rows = [["a", "0.3 m", "5"], ["b", "30 cm", "4"]];
        let by_size = drawing(&rows, r#"{"x": "size", "y": "time_s"}"#);
        assert_eq!(by_size.categories, ["0.3 m", "30 cm"]);
        let by_scene = drawing(&rows, r#"{"x": "scene", "y": "time_s", "series": "size"}"#);
        assert_eq!((by_scene.categories.len(), by_scene.units[0].as_str()), (2, ""));
    }

    /// One line has one style in all panels.
    #[test]
    fn panels_share_their_lines() {
        let rows = [["a", "1", "5"], ["b", "2", "4"], ["b", "1", "3"]];
        let plot = r#"{"x": "time_s", "y": "time_s", "series": "size", "facet": "scene"}"#;
        let drawing = drawing(&rows, plot);
        assert_eq!(drawing.names, ["size 1", "size 2"]);
        let panels: Vec<&str> = drawing.panels.iter().map(|panel| panel.name.as_str()).collect();
        assert_eq!(panels, ["a", "b"]);
        assert_eq!(lines(&drawing, 1), [("size 2", &[(4.0, 4.0)][..]), ("size 1", &[(3.0, 3.0)])]);
    }

    #[test]
    fn repeats_are_their_mean() {
        let rows = [["a", "1", "5"], ["b", "1", "3"], ["a", "2", "7"], ["b", "2", ""]];
        let drawing = drawing(&rows, r#"{"x": "size", "y": "time_s", "over": "scene"}"#);
        assert_eq!(lines(&drawing, 0), [("", &[(1.0, 4.0), (2.0, 7.0)][..])]);
        let counts = drawing.panels[0].series[0].repeats.iter().map(|(_, repeats)| repeats.count);
        assert_eq!(counts.collect::<Vec<_>>(), [2, 1]);
    }

    #[test]
    fn a_panel_without_points_says_why() {
        let rows = [["a", "1", "5"], ["b", "1", ""]];
        let drawing = drawing(&rows, r#"{"x": "size", "y": "time_s", "facet": "scene"}"#);
        assert_eq!(drawing.panels[0].empty, "");
        assert_eq!(drawing.panels[1].empty, "No run has a number as time_s.");
    }
}
