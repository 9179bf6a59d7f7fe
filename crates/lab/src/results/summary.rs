//! How close simulated figures are to published ones.

use crate::table::runs_csv::Table;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Geometric mean of max(simulated/paper, paper/simulated) over the speed-ups on more than
    /// one processor; none if there are none to compare.
    pub speed_ups: Option<Spread>,
    /// For each run on one processor: its group, and its time over the paper's.
    pub one_processor: Vec<(String, f64)>,
}

/// How far ratios are from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Spread {
    pub cells: usize,
    /// Their geometric mean, each ratio or its inverse, whichever is above 1.
    pub mean: f64,
    /// The one farthest from 1, simulated over published.
    pub worst: f64,
    /// Its group and processors.
    pub worst_at: String,
}

impl Summary {
    pub fn of(table: &Table, sweeps: &[String]) -> Summary {
        let mut summary = Summary::default();
        let mut ratios = Vec::new();
        for row in &table.rows {
            let (group, processors) = (group(table, row, sweeps), table.cell(row, "processors"));
            if processors == "1" {
                let time = ratio(table, row, "time_s", "paper_time_s");
                summary.one_processor.extend(time.map(|ratio| (group, ratio)));
            } else if let Some(ratio) = ratio(table, row, "speed_up", "paper_speed_up") {
                ratios.push((ratio, format!("{group} on {processors}")));
            }
        }
        summary.speed_ups = spread(&ratios);
        summary
    }

    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if !self.one_processor.is_empty() {
            let ratios =
                self.one_processor.iter().map(|(scene, ratio)| format!("{scene} {ratio:.3}"));
            let ratios = ratios.collect::<Vec<_>>().join(", ");
            lines.push(format!("Time on one processor, simulated over paper: {ratios}."));
        }
        if let Some(Spread { cells, mean, worst, worst_at }) = &self.speed_ups {
            let plural = if *cells == 1 { "" } else { "s" };
            lines.push(format!(
                "{cells} speed-up{plural} on more than one processor: the geometric mean of \
                 max(simulated/paper, paper/simulated) is {mean:.3}; the farthest is {worst_at}, {worst:.2} \
                 times the paper's."
            ));
        }
        lines
    }
}

/// The group of a row: its scene, and the values of other swept fields but the processors.
pub fn group(table: &Table, row: &[String], sweeps: &[String]) -> String {
    let others = sweeps.iter().filter(|name| *name != "scene" && *name != "processors");
    let others = others.map(|name| format!("{name} {}", table.cell(row, name)));
    let scene = table.cell(row, "scene").to_owned();
    std::iter::once(scene).chain(others).collect::<Vec<_>>().join(", ")
}

/// Simulated over published, where the row has both.
pub fn ratio(table: &Table, row: &[String], ours: &str, paper: &str) -> Option<f64> {
    let (ours, paper) = (table.number(row, ours)?, table.number(row, paper)?);
    (ours > 0.0 && paper > 0.0).then(|| ours / paper)
}

fn spread(ratios: &[(f64, String)]) -> Option<Spread> {
    let distance = |ratio: f64| ratio.ln().abs();
    let (worst, worst_at) =
        ratios.iter().max_by(|a, b| distance(a.0).total_cmp(&distance(b.0)))?.clone();
    let sum: f64 = ratios.iter().map(|(ratio, _)| distance(*ratio)).sum();
    let mean = (sum / ratios.len() as f64).exp();
    Some(Spread { cells: ratios.len(), mean, worst, worst_at })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[[&str; 6]]) -> Table {
        let columns =
            ["scene", "processors", "time_s", "speed_up", "paper_time_s", "paper_speed_up"];
        let own = |row: &[&str; 6]| row.map(str::to_owned).to_vec();
        Table { columns: own(&columns), rows: rows.iter().map(own).collect() }
    }

    #[test]
    fn the_mean_takes_each_ratio_the_way_that_it_exceeds_1() {
        let rows = table(&[
            ["a", "1", "9", "1", "10", "1"],
            ["a", "2", "5", "2", "10", "1"],
            ["a", "4", "5", "1", "10", "8"],
            ["a", "8", "5", "1", "", ""],
        ]);
        let summary = Summary::of(&rows, &["time_s".to_owned()]);
        let speed_ups = summary.speed_ups.unwrap();
        assert_eq!(summary.one_processor, [("a, time_s 9".to_owned(), 0.9)]);
        assert_eq!(speed_ups.cells, 2);
        assert!((speed_ups.mean - 4.0).abs() < 1e-12, "{speed_ups:?}");
        assert_eq!((speed_ups.worst, speed_ups.worst_at.as_str()), (0.125, "a, time_s 5 on 4"));
    }

    #[test]
    fn nothing_published_is_nothing_to_say() {
        assert!(Summary::of(&table(&[["a", "1", "9", "1", "", ""]]), &[]).lines().is_empty());
    }
}
