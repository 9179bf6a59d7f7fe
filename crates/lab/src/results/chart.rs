//! Plots as SVG. Lines differ in colour, marker and dash, published ones are finely dotted with hollow markers. Where
//! lines coincide, each draws some of the dashes, and markers below others are larger.

use crate::experiment::plot::Plot;
use crate::results::axes::Axes;
use crate::results::canvas::{self, Canvas, Drawn, GREY, INK, PALE, Side, px};
use crate::results::label_places::places;
use crate::results::layout::{Frame, HEAD, LETTER, Layout, SAMPLE, line_name};
use crate::results::marks::{
    self, BAND, Ideal, draw_leader, draw_marks, draw_sample, end, fine, ideal,
};
use crate::results::scale::Scale;
use crate::results::series::{Drawing, Panel, Series};
use crate::results::strokes::{ALONE, Spot, strokes};
use crate::results::style::{Marker, PUBLISHED, STYLES, Style};
use crate::table::axis_title::words;
use crate::table::measure::Measure;
use crate::table::runs_csv::Table;

/// Draws a plot of the results as the text of an SVG file. Speed-ups are over `base` processors.
pub fn svg(table: &Table, sweeps: &[String], plot: &Plot, base: u32) -> String {
    let drawing = Drawing::of(table, sweeps, plot);
    let title = title(plot);
    let layout = Layout::of(&drawing, title.chars().count());
    let (x, y) = (x_scale(&drawing, plot), y_scale(&drawing, plot));
    let ideal = ideal(plot, base, [x.ends(), y.ends()]);
    canvas::svg(layout.size, |canvas| {
        canvas.text(&title, (px(24), px(26)), 19, INK, Side::Right)?;
        for (number, panel) in drawing.panels.iter().enumerate() {
            let axes = Axes { frame: layout.frame(number), x: &x, y: &y };
            // Without points axes have no values.
            let numbers = layout.has_numbers(number).map(|has| has && !drawing.is_empty());
            axes.draw(canvas, numbers, layout.turned)?;
            let name = (axes.frame.left, axes.frame.top - px(14));
            canvas.text(&layout.panel_name(&panel.name), name, 15, INK, Side::Right)?;
            draw_panel(canvas, &axes, panel, plot, ideal)?;
            if layout.is_single() {
                draw_names(canvas, &axes, &layout, &drawing)?;
            } else {
                draw_laws(canvas, &axes, panel)?;
            }
        }
        if !layout.is_single() {
            draw_legend(canvas, &layout, &drawing)?;
        }
        draw_titles(canvas, &layout, &drawing, plot)?;
        draw_key(canvas, &layout, &drawing, plot, ideal.is_some())
    })
}

fn title(plot: &Plot) -> String {
    let (x, y) = (Measure::of(&plot.x), Measure::of(&plot.y));
    let title = || format!("{} by {}", y.words(), x.words().to_lowercase());
    plot.title.clone().unwrap_or_else(title)
}

fn x_scale(drawing: &Drawing, plot: &Plot) -> Scale {
    if !drawing.categories.is_empty() {
        return Scale::names(&drawing.categories);
    }
    let values = drawing.points().map(|(x, _)| x);
    let lines = plot.lines.iter().filter_map(|line| line.x);
    let all = values.clone().chain(lines);
    let scale = if plot.logarithmic()[0] { Scale::logarithmic(all) } else { Scale::linear(all) };
    // Figures of runs are no round numbers.
    if drawing.swept { scale.ticked_at(values) } else { scale }
}

fn y_scale(drawing: &Drawing, plot: &Plot) -> Scale {
    let lines = plot.lines.iter().filter_map(|line| line.y);
    let all = drawing.points().map(|(_, y)| y).chain(lines);
    if plot.logarithmic()[1] { Scale::logarithmic(all) } else { Scale::linear(all) }
}

/// What is inside the axes, or why there is nothing.
fn draw_panel(
    canvas: &Canvas,
    axes: &Axes,
    panel: &Panel,
    plot: &Plot,
    ideal: Option<Ideal>,
) -> Drawn {
    if panel.empty.is_empty() {
        return draw_marks(canvas, axes, panel, plot, ideal);
    }
    let Frame { left, top, right, bottom } = axes.frame;
    canvas.blank([(left + px(1), top - px(1)), (right + px(1), bottom - px(1))])?;
    // A line of text for each sentence.
    let sentences: Vec<&str> = panel.empty.split_inclusive(". ").collect();
    for (line, sentence) in (0..).zip(sentences) {
        let (x, y) = axes.frame.middle();
        let at = (x, y - px(30) + px(20) * line);
        canvas.text(sentence.trim_end(), at, 14, INK, Side::Below)?;
    }
    Ok(())
}

/// Titles of the axes, once for all panels.
fn draw_titles(canvas: &Canvas, layout: &Layout, drawing: &Drawing, plot: &Plot) -> Drawn {
    let whole = layout.whole();
    let [x, y] = [&plot.x, &plot.y].map(|text| Measure::of(text));
    let [x_unit, y_unit] = &drawing.units;
    let (middle, center) = whole.middle();
    canvas.text(&x.title(x_unit), (middle, layout.below_numbers()), 15, INK, Side::Below)?;
    canvas.text(&y.title(y_unit), (px(22), center), 15, INK, Side::Upright)
}

/// The name of a line of a single panel, with its law.
fn name(drawing: &Drawing, series: &Series) -> String {
    let law = series.law.map(|law| law.words());
    let name = Some(drawing.names[series.line].clone()).filter(|name| !name.is_empty());
    name.into_iter().chain(law).collect::<Vec<_>>().join(": ")
}

/// Each line's name at the right of the axes, moved apart where two would overlap, with a leader from its end.
fn draw_names(canvas: &Canvas, axes: &Axes, layout: &Layout, drawing: &Drawing) -> Drawn {
    let named = drawing.panels[0].series.iter().map(|series| (series, name(drawing, series)));
    let ends = named.filter(|(_, name)| !name.is_empty());
    let ends = ends.filter_map(|(series, name)| Some((end(axes, series)?, series, name)));
    let mut ends: Vec<(Spot, &Series, String)> = ends.collect();
    ends.sort_by_key(|(end, series, _)| (end.1, series.line));
    let wanted: Vec<i32> = ends.iter().map(|(end, ..)| end.1).collect();
    let (left, bottom) = (layout.names(), px(layout.size.1) - px(LETTER.1));
    let places = places(&wanted, px(LETTER.1), axes.frame.top, bottom);
    for ((end, series, name), y) in ends.into_iter().zip(places) {
        let style = Style::of(series.line);
        draw_leader(canvas, end, axes.frame.right + px(4), (left - px(4), y), style)?;
        draw_entry(canvas, (left, y), series, &name)?;
    }
    Ok(())
}

/// A sample of a line, and its name.
fn draw_entry(canvas: &Canvas, (x, y): Spot, series: &Series, name: &str) -> Drawn {
    draw_sample(canvas, (x, y), Style::of(series.line), series.simulated.is_empty())?;
    canvas.text(&line_name(name), (x + px(SAMPLE + 5), y), 15, INK, Side::Right)
}

/// The lines of all panels, one below another.
fn draw_legend(canvas: &Canvas, layout: &Layout, drawing: &Drawing) -> Drawn {
    let (left, top) = (layout.names(), layout.whole().top);
    let named = drawing.names.iter().enumerate().filter(|(_, name)| !name.is_empty());
    let mut y = top + px(LETTER.1 / 2);
    for (line, name) in named {
        let all = || drawing.series_of_all().filter(|series| series.line == line);
        let shown = all().find(|series| !series.simulated.is_empty());
        let shown = shown.or(all().find(|series| !series.paper.is_empty()));
        if let Some(series) = shown {
            draw_entry(canvas, (left, y), series, name)?;
            y += px(LETTER.1);
        }
    }
    Ok(())
}

/// The laws of the lines of one panel among several, in its upper left corner.
fn draw_laws(canvas: &Canvas, axes: &Axes, panel: &Panel) -> Drawn {
    let mut y = axes.frame.top + px(9);
    for (series, law) in panel.series.iter().filter_map(|series| Some((series, series.law?))) {
        let (left, style) = (axes.frame.left + px(8), Style::of(series.line));
        canvas.marker(style.marker, (left + px(4), y), marks::MARKER, style.colour, false)?;
        canvas.text(&law.words(), (left + px(14), y), 12, INK, Side::Right)?;
        y += px(15);
    }
    Ok(())
}

/// What marks mean, in a row above the axes, where no line can run.
fn draw_key(
    canvas: &Canvas,
    layout: &Layout,
    drawing: &Drawing,
    plot: &Plot,
    ideal: bool,
) -> Drawn {
    let y = px(HEAD - 18);
    let mut x = layout.whole().left;
    // Names an entry; the next one begins after it.
    let name = |x: &mut i32, name: &str| -> Drawn {
        canvas.text(name, (*x + px(38), y), 14, INK, Side::Right)?;
        *x += px(62 + LETTER.0 * name.chars().count() as u32);
        Ok(())
    };
    let sample = |x: i32, dash, width, hollow| -> Drawn {
        let line = [(x, y), (x + px(30), y)];
        for stroke in strokes(&line, &[ALONE], &fine(dash), 0.0) {
            canvas.line(stroke, GREY, width)?;
        }
        canvas.marker(Marker::Circle, (x + px(15), y), marks::MARKER, GREY, hollow)
    };
    let all = || drawing.series_of_all();
    if all().any(|series| !series.paper.is_empty()) {
        sample(x, &[], marks::WIDTHS.0, false)?;
        name(&mut x, "simulated")?;
        sample(x, PUBLISHED, marks::WIDTHS.1, true)?;
        name(&mut x, drawing.publisher)?;
    }
    if ideal {
        canvas.line([(x, y), (x + px(30), y)], PALE, 1.25)?;
        name(&mut x, "ideal")?;
    }
    if all().any(|series| !series.marked.is_empty()) {
        canvas.ring((x + px(20), y), 9)?;
        name(&mut x, plot.mark_name.as_deref().unwrap_or("marked"))?;
    }
    if let Some(over) = &plot.over {
        let (top, bottom) = (y - px(7), y + px(7));
        let corners = vec![(x, top), (x + px(30), top), (x + px(30), bottom), (x, bottom)];
        canvas.fill(corners, GREY, 2.0 * BAND)?;
        canvas.line([(x, y), (x + px(30), y)], GREY, marks::WIDTHS.0)?;
        name(&mut x, &format!("mean, 5–95 % over {}", words(over)))?;
    }
    for note in notes(drawing) {
        canvas.text(&note, (x, y), 14, GREY, Side::Right)?;
        x += px(24 + LETTER.0 * note.chars().count() as u32);
    }
    Ok(())
}

/// What a reader of the figure must know besides.
fn notes(drawing: &Drawing) -> Vec<String> {
    let mut notes = Vec::new();
    if drawing.left_out > 0 {
        let plural = if drawing.left_out == 1 { "" } else { "s" };
        notes.push(format!("{} point{plural} not above zero left out", drawing.left_out));
    }
    if drawing.names.len() > STYLES {
        notes.push(format!("{} lines: styles repeat after {STYLES}", drawing.names.len()));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(columns: &[&str], rows: &[Vec<String>]) -> Table {
        Table {
            columns: columns.iter().map(|&name| name.to_owned()).collect(),
            rows: rows.to_vec(),
        }
    }

    fn plot(text: &str) -> Plot {
        serde_json::from_str(text).unwrap()
    }

    /// Lines that coincide all show: each has its colour and dash, or its turns, and all markers.
    #[test]
    fn a_sweep_of_24_lines_draws_each() {
        let rows: Vec<Vec<String>> = (0..STYLES * 3)
            .map(|i| vec![format!("line {}", i / 3), (i % 3 + 1).to_string(), "7".to_owned()])
            .collect();
        let table = table(&["series", "x", "y"], &rows);
        let sweeps = ["series", "x"].map(str::to_owned);
        let svg = svg(&table, &sweeps, &plot(r#"{"x": "x", "y": "y"}"#), 1);
        for line in 0..STYLES {
            assert!(svg.contains(&format!("\nline {line}\n")), "{line}");
        }
        let strokes = |colour: &str| {
            let lines =
                svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(colour));
            lines.filter(|line| line.contains("stroke-width=\"16\"")).count()
        };
        // Three lines of a colour, two segments, one turn or more each.
        assert!(strokes("#0072B2") >= 6 && strokes("#E69F00") >= 6);
        assert!(!svg.contains("styles repeat"));
    }

    #[test]
    fn an_empty_plot_says_why() {
        let row = |ending: &str| ["1", "", ending].map(str::to_owned).to_vec();
        let columns = ["x", "y", "ending"];
        let empty =
            plot(r#"{"x": "x", "y": "y", "log_y": true, "lines": [{"y": 1, "label": "one"}]}"#);
        let failed = svg(&table(&columns, &[row("failed"), row("failed")]), &[], &empty, 1);
        assert!(failed.contains("All 2 runs failed."), "{failed}");
        let agreed = svg(&table(&columns, &[row("agreed")]), &[], &empty, 1);
        assert!(agreed.contains("No run has a number as y."), "{agreed}");
        assert!(svg(&table(&columns, &[]), &[], &empty, 1).contains("There are no runs."));
    }

    #[test]
    fn reference_lines_and_titles_are_written() {
        let rows = [vec!["1".to_owned(), "3 %".to_owned()], vec!["2".to_owned(), "4 %".to_owned()]];
        let asked =
            r#"{"x": "time_s", "y": "share", "lines": [{"y": 9, "label": "goal"}, {"x": 1.5}]}"#;
        let svg = svg(&table(&["time_s", "share"], &rows), &[], &plot(asked), 1);
        for text in ["goal", "Time (s)", "Share (%)", "Share by time"] {
            assert!(svg.contains(text), "{text}: {svg}");
        }
    }
}
