//! The points and lines of a panel.

use crate::experiment::plot::Plot;
use crate::results::axes::Axes;
use crate::results::canvas::{Canvas, Drawn, GREY, PALE, Side, px};
use crate::results::layout::SAMPLE;
use crate::results::power_law::PowerLaw;
use crate::results::series::{Panel, Series};
use crate::results::strokes::{ALONE, Spot, strokes, turns};
use crate::results::style::{Marker, PUBLISHED, Style};

/// Widths of lines, simulated and published, pixels.
pub const WIDTHS: (f64, f64) = (2.0, 1.25);
/// Radius of a marker, pixels, and by how much one below another is larger. No more than a few show.
pub const MARKER: f64 = 4.0;
const LARGER: f64 = 1.5;
const MOST_BELOW: usize = 5;
/// Lines and points as near as this coincide, drawing units.
const NEAR: i32 = px(1) + px(1) / 2;
/// A line's turn where several coincide, pixels.
const TURN: u32 = 9;
/// Opacity of a band.
pub const BAND: f64 = 0.18;

/// Draws reference lines, bands, lines and points, each above the one before.
pub fn draw_marks(
    canvas: &Canvas,
    axes: &Axes,
    panel: &Panel,
    plot: &Plot,
    ideal: Option<Ideal>,
) -> Drawn {
    draw_reference_lines(canvas, axes, plot, ideal)?;
    for series in &panel.series {
        draw_band(canvas, axes, series)?;
    }
    let lines: Vec<Vec<Spot>> = panel.series.iter().map(|series| line(axes, series)).collect();
    for ((line, turns), series) in lines.iter().zip(turns(&lines, NEAR)).zip(&panel.series) {
        let style = Style::of(series.line);
        let published: Vec<Spot> = series.paper.iter().map(|at| axes.spot(*at)).collect();
        let of_paper = published_style(panel, series);
        let alone = vec![ALONE; published.len().saturating_sub(1)];
        for stroke in strokes(&published, &alone, &fine(PUBLISHED), 0.0) {
            canvas.line(stroke, of_paper.colour, WIDTHS.1)?;
        }
        for stroke in strokes(line, &turns, &fine(style.dash), f64::from(px(TURN))) {
            canvas.line(stroke, style.colour, WIDTHS.0)?;
        }
    }
    draw_points(canvas, axes, panel)
}

/// Lengths of dashes in drawing units.
pub fn fine(pattern: &[u32]) -> Vec<f64> {
    pattern.iter().map(|&pixels| f64::from(px(pixels))).collect()
}

/// The ends of the line of the ideal speed-up: processors, speed-up.
pub type Ideal = [(f64, f64); 2];

/// The ideal speed-up over `base` processors inside these ends of x and y; none if the plot is of something else, or
/// the line is outside.
pub fn ideal(plot: &Plot, base: u32, [[left, right], [low, high]]: [[f64; 2]; 2]) -> Option<Ideal> {
    let base = f64::from(base);
    let (from, to) = (left.max(low * base).max(0.0), right.min(high * base));
    let of_speed_up = plot.x == "processors" && plot.y == "speed_up";
    (of_speed_up && from < to).then(|| [from, to].map(|x| (x, x / base)))
}

/// The ideal speed-up, and the lines that the plot asks for with what they mean.
fn draw_reference_lines(canvas: &Canvas, axes: &Axes, plot: &Plot, ideal: Option<Ideal>) -> Drawn {
    let ([x_low, x_high], [y_low, y_high]) = (axes.x.ends(), axes.y.ends());
    if let Some(ends) = ideal {
        canvas.line(ends.map(|end| axes.clamped(end)), PALE, 1.25)?;
    }
    for reference in &plot.lines {
        let ends = match (reference.x, reference.y) {
            (Some(x), _) if axes.x.is_of_names() => return no_place(canvas, axes, x),
            (Some(x), _) => [(x, y_low), (x, y_high)],
            (_, Some(y)) => [(x_low, y), (x_high, y)],
            _ => continue,
        };
        let [from, to] = ends.map(|end| axes.clamped(end));
        canvas.line([from, to], GREY, 1.25)?;
        let (label, text_at) = match reference.x {
            Some(_) => (Side::Right, (to.0 + px(4), to.1 + px(8))),
            None => (Side::Left, (to.0 - px(4), to.1 - px(8))),
        };
        canvas.text(&reference.label, text_at, 13, GREY, label)?;
    }
    Ok(())
}

fn no_place(canvas: &Canvas, axes: &Axes, x: f64) -> Drawn {
    let text = format!("no line at x = {x}: this axis has names");
    canvas.text(&text, (axes.frame.left + px(4), axes.frame.top + px(8)), 13, GREY, Side::Right)
}

/// The band of repeats; a bar where there is only one x.
fn draw_band(canvas: &Canvas, axes: &Axes, series: &Series) -> Drawn {
    let colour = Style::of(series.line).colour;
    let low = series.repeats.iter().map(|(x, repeats)| axes.spot((*x, repeats.low)));
    let high = series.repeats.iter().rev().map(|(x, repeats)| axes.spot((*x, repeats.high)));
    let corners: Vec<Spot> = low.chain(high).collect();
    match corners[..] {
        [low, high] => canvas.line([low, high], colour, 1.25),
        [] => Ok(()),
        _ => canvas.fill(corners, colour, BAND),
    }
}

/// The line through a series.
fn line(axes: &Axes, series: &Series) -> Vec<Spot> {
    // A law is straight between its ends: both axes are logarithmic.
    let through = |law: PowerLaw| -> Vec<(f64, f64)> {
        series.simulated.iter().map(|&(x, _)| (x, law.at(x))).collect()
    };
    let points = match (&series.law, &series.front) {
        (Some(law), _) => through(*law),
        (None, Some(front)) => front.clone(),
        (None, None) => series.simulated.clone(),
    };
    points.into_iter().map(|at| axes.spot(at)).collect()
}

/// The style of a line's published points: its own, unless several lines are compared with the same.
fn published_style(panel: &Panel, series: &Series) -> Style {
    let same = panel.series.iter().filter(|other| other.paper == series.paper).count();
    let own = Style::of(series.line);
    if same > 1 { Style { colour: GREY, marker: Marker::Circle, ..own } } else { own }
}

fn draw_points(canvas: &Canvas, axes: &Axes, panel: &Panel) -> Drawn {
    for series in &panel.series {
        let Style { colour, marker, .. } = published_style(panel, series);
        // A single point, where the two should agree, would hide behind ours: a larger one around it.
        let radius = if series.paper.len() == 1 { 2.0 * MARKER } else { MARKER };
        for &at in &series.paper {
            canvas.marker(marker, axes.spot(at), radius, colour, true)?;
        }
    }
    // Points that are not joined are many: they are small, and below the others.
    for series in &panel.series {
        for &at in series.simulated.iter().filter(|at| !is_joined(series, at)) {
            canvas.dot(axes.spot(at), 2, Style::of(series.line).colour)?;
        }
    }
    let joined: Vec<Vec<Spot>> = panel
        .series
        .iter()
        .map(|series| {
            series
                .simulated
                .iter()
                .filter(|at| is_joined(series, at))
                .map(|at| axes.spot(*at))
                .collect()
        })
        .collect();
    for (i, series) in panel.series.iter().enumerate() {
        let Style { colour, marker, .. } = Style::of(series.line);
        for &at in &joined[i] {
            let above =
                joined[i + 1..].iter().filter(|line| passes(line, at)).take(MOST_BELOW).count();
            canvas.marker(marker, at, MARKER + LARGER * above as f64, colour, false)?;
        }
        for &at in &series.marked {
            canvas.ring(axes.spot(at), 8)?;
            canvas.ring(axes.spot(at), 9)?;
        }
    }
    Ok(())
}

fn is_joined(series: &Series, at: &(f64, f64)) -> bool {
    series.front.as_ref().is_none_or(|front| front.contains(at))
}

/// Whether a line, with rising x, has a point at a place.
fn passes(line: &[Spot], at: Spot) -> bool {
    let first = line.partition_point(|spot| spot.0 < at.0 - NEAR);
    let mut near = line[first..].iter().take_while(|spot| spot.0 <= at.0 + NEAR);
    near.any(|spot| (spot.1 - at.1).abs() <= NEAR)
}

/// The end of a series, which its name is beside.
pub fn end(axes: &Axes, series: &Series) -> Option<Spot> {
    let of_front = series.front.as_ref().and_then(|front| front.last());
    let end = of_front.or(series.simulated.last()).or(series.paper.last())?;
    Some(axes.spot(*end))
}

/// A sample of a line that begins at a place: line and marker.
pub fn draw_sample(canvas: &Canvas, (x, y): Spot, style: Style, hollow: bool) -> Drawn {
    let line = [(x, y), (x + px(SAMPLE), y)];
    let width = if hollow { WIDTHS.1 } else { WIDTHS.0 };
    for stroke in strokes(&line, &[ALONE], &fine(style.dash), 0.0) {
        canvas.line(stroke, style.colour, width)?;
    }
    canvas.marker(style.marker, (x + px(SAMPLE / 2), y), MARKER, style.colour, hollow)
}

/// A thin leader from the end of a line to its name.
pub fn draw_leader(canvas: &Canvas, end: Spot, edge: i32, to: Spot, style: Style) -> Drawn {
    let begin = (end.0 + px(9), end.1);
    let spots: Vec<Spot> = [begin, (edge.max(begin.0), end.1), to].to_vec();
    canvas.line(spots, style.colour, 0.75)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ideal_speed_up_is_processors_over_the_base() {
        let plot = |y: &str| -> Plot {
            serde_json::from_str(&format!(r#"{{"x": "processors", "y": "{y}"}}"#)).unwrap()
        };
        let of = |base, axes| ideal(&plot("speed_up"), base, axes);
        assert_eq!(of(1, [[0.0, 60.0], [0.0, 50.0]]), Some([(0.0, 0.0), (50.0, 50.0)]));
        assert_eq!(of(8, [[0.0, 56.0], [0.0, 50.0]]), Some([(0.0, 0.0), (56.0, 7.0)]));
        assert_eq!(of(8, [[1.0, 56.0], [0.5, 6.0]]), Some([(4.0, 0.5), (48.0, 6.0)]));
        assert_eq!(of(1, [[32.0, 64.0], [0.0, 5.0]]), None);
        assert_eq!(ideal(&plot("time_s"), 1, [[0.0, 60.0], [0.0, 50.0]]), None);
    }
}
