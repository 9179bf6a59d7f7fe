//! The table on the terminal, in the manner of the paper's Table 1.

use crate::summary::{Summary, ratio};
use crate::table::Table;

/// The results as text: for each scene (and value of what is swept besides) times and speed-ups
/// by processors, beside the paper's where there are any, and the summary.
pub fn table_text(table: &Table, sweeps: &[String]) -> String {
    let compared = table.rows.iter().any(|row| !table.cell(row, "paper_speed_up").is_empty());
    let mut text = String::new();
    let mut line = |cells: String| {
        text.push_str(cells.trim_end());
        text.push('\n');
    };
    if compared {
        line(format!("{:>9}{:>22}{:>24}", "", "simulated", "paper"));
        line(heading() + &format!("{:>14}{:>10}{:>9}", "time s", "speed-up", "ratio"));
    } else {
        line(heading());
    }
    let mut current = None;
    for row in &table.rows {
        let group = group(table, row, sweeps);
        if current.as_ref() != Some(&group) {
            line(group.clone());
            current = Some(group);
        }
        line(row_text(table, row));
    }
    for sentence in Summary::of(table).lines() {
        line(String::new());
        line(sentence);
    }
    text
}

fn heading() -> String {
    format!("{:>9}{:>12}{:>10}", "procs", "time s", "speed-up")
}

/// What the rows of a group share: the scene and the values of other sweeps.
fn group(table: &Table, row: &[String], sweeps: &[String]) -> String {
    let others = sweeps.iter().filter(|name| *name != "scene" && *name != "processors");
    let others = others.map(|name| format!("{name} {}", table.cell(row, name)));
    let scene = table.cell(row, "scene").to_owned();
    std::iter::once(scene).chain(others).collect::<Vec<_>>().join(", ")
}

fn row_text(table: &Table, row: &[String]) -> String {
    let processors = table.cell(row, "processors");
    if table.cell(row, "ending") == "failed" {
        return format!("{processors:>9}  failed: {}", table.cell(row, "failure"));
    }
    let number = |column| {
        table.number(row, column).map_or(String::new(), |number| format!("{number:.2}"))
    };
    let speed_ups = ratio(table, row, "speed_up", "paper_speed_up").filter(|_| processors != "1");
    let times = ratio(table, row, "time_s", "paper_time_s").filter(|_| processors == "1");
    // On one processor the speed-up is 1 by its meaning: there the times are what compares.
    let compared = match (speed_ups, times) {
        (Some(ratio), _) => format!("{ratio:.2}"),
        (None, Some(ratio)) => format!("t {ratio:.2}"),
        (None, None) => String::new(),
    };
    let mark = if table.cell(row, "ending") == "too_early" { "  ended too early" } else { "" };
    format!(
        "{processors:>9}{:>12}{:>10}{:>14}{:>10}{compared:>9}{mark}",
        number("time_s"),
        number("speed_up"),
        number("paper_time_s"),
        number("paper_speed_up"),
    )
}
