//! Plots as SVG, through plotters. Simulated figures are solid lines with filled markers, the
//! paper's are dashed lines with hollow markers of the same colour.

use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::experiment::Plot;
use crate::scale::Scale;
use crate::series::{Drawing, Series};
use crate::table::Table;

/// Size of a plot, pixels.
const SIZE: (u32, u32) = (800, 540);
/// Room on the right for the names of lines, pixels.
const NAMES: u32 = 130;
/// Height of a line's name, pixels.
const NAME_HEIGHT: i32 = 17;

/// Okabe and Ito's colours, which colour-blind readers can tell apart.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(170, 90, 140),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
];
const INK: RGBColor = RGBColor(40, 40, 40);
const GREY: RGBColor = RGBColor(120, 120, 120);
const PALE: RGBColor = RGBColor(190, 190, 190);
const GRID: RGBColor = RGBColor(232, 232, 232);

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Scale, Scale>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Draws a plot of the results as the text of an SVG file.
pub fn svg(table: &Table, sweeps: &[String], plot: &Plot) -> String {
    let drawing = Drawing::of(table, sweeps, plot);
    let mut text = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(&area, &drawing, plot)
    };
    match drawn {
        Ok(()) => text,
        // Drawing to memory does not fail; should a plot ever, it says so in its place.
        Err(error) => format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><desc>{error}</desc></svg>"),
    }
}

fn draw(area: &Area, drawing: &Drawing, plot: &Plot) -> Drawn {
    let title = plot.title.clone().unwrap_or_else(|| {
        let title = format!("{} by {}", label(&plot.y), label(&plot.x).to_lowercase());
        title.replace(" (s)", "")
    });
    area.fill(&WHITE)?;
    area.draw(&Text::new(title, (24, 18), font(19).color(&INK)))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(56)
        .margin_right(NAMES)
        .margin_bottom(14)
        .margin_left(14)
        .x_label_area_size(48)
        .y_label_area_size(62)
        .build_cartesian_2d(x_scale(drawing, plot), y_scale(drawing, plot))?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(PALE)
        .label_style(font(14).color(&INK))
        .axis_desc_style(font(15).color(&INK))
        .x_desc(label(&plot.x))
        .y_desc(label(&plot.y))
        .draw()?;
    let ideal = plot.x == "processors" && plot.y == "speed_up";
    if ideal {
        draw_ideal(&mut chart)?;
    }
    for (i, series) in drawing.series.iter().enumerate() {
        draw_series(&mut chart, series, i)?;
    }
    draw_names(area, &chart, drawing)?;
    draw_key(area, &chart, drawing, ideal)
}

fn x_scale(drawing: &Drawing, plot: &Plot) -> Scale {
    let values = drawing.points().map(|(x, _)| x);
    match plot.log_x {
        _ if !drawing.categories.is_empty() => Scale::names(&drawing.categories),
        true => Scale::logarithmic(values),
        false => Scale::linear(values),
    }
}

fn y_scale(drawing: &Drawing, plot: &Plot) -> Scale {
    let values = drawing.points().map(|(_, y)| y);
    if plot.log_y { Scale::logarithmic(values) } else { Scale::linear(values) }
}

/// The speed-up that equals the number of processors.
fn draw_ideal(chart: &mut Chart) -> Drawn {
    let (x, y) = (chart.x_range(), chart.y_range());
    let (from, to) = (x.start.max(y.start), x.end.min(y.end));
    chart.draw_series(LineSeries::new([(from, from), (to, to)], PALE.stroke_width(1)))?;
    Ok(())
}

fn draw_series(chart: &mut Chart, series: &Series, index: usize) -> Drawn {
    let colour = colour(index);
    let paper = series.paper.iter().copied();
    let dashes = DashedLineSeries::new(paper.clone(), 6, 4, colour.mix(0.75).stroke_width(1));
    chart.draw_series(dashes)?;
    let lines = series.simulated.iter().copied();
    chart.draw_series(LineSeries::new(lines.clone(), colour.stroke_width(2)))?;
    chart.draw_series(paper.map(|at| Circle::new(at, 4, WHITE.filled())))?;
    chart.draw_series(series.paper.iter().map(|&at| Circle::new(at, 4, colour.stroke_width(1))))?;
    chart.draw_series(lines.map(|at| Circle::new(at, 4, colour.filled())))?;
    Ok(())
}

/// Each line's name at its right end, moved apart where two would lie on each other.
fn draw_names(area: &Area, chart: &Chart, drawing: &Drawing) -> Drawn {
    let ends = drawing.series.iter().enumerate().filter(|(_, series)| !series.name.is_empty());
    let mut ends: Vec<(i32, usize)> = ends
        .filter_map(|(i, series)| {
            let end = series.simulated.last().or(series.paper.last())?;
            Some((chart.backend_coord(end).1, i))
        })
        .collect();
    ends.sort_unstable();
    let left = (SIZE.0 - NAMES) as i32 + 12;
    let bottom = SIZE.1 as i32 - 62 - NAME_HEIGHT * (ends.len() as i32 - 1);
    let mut lowest = i32::MIN;
    for (rank, (y, i)) in ends.into_iter().enumerate() {
        let y = y.max(lowest).min(bottom + NAME_HEIGHT * rank as i32);
        lowest = y + NAME_HEIGHT;
        let colour = colour(i);
        let style = font(15).color(&colour).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(drawing.series[i].name.clone(), (left, y), style))?;
    }
    Ok(())
}

/// What solid and dashed lines mean.
fn draw_key(area: &Area, chart: &Chart, drawing: &Drawing, ideal: bool) -> Drawn {
    let (xs, ys) = chart.plotting_area().get_pixel_range();
    let (x, mut y) = (xs.start + 18, ys.start + 16);
    let style = || font(14).color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    if drawing.series.iter().any(|series| !series.paper.is_empty()) {
        area.draw(&PathElement::new([(x, y), (x + 36, y)], GREY.stroke_width(2)))?;
        area.draw(&Circle::new((x + 18, y), 4, GREY.filled()))?;
        area.draw(&Text::new("simulated", (x + 46, y), style()))?;
        y += 21;
        for dash in [0, 10, 20, 30] {
            let ends = [(x + dash, y), (x + dash + 6, y)];
            area.draw(&PathElement::new(ends, GREY.stroke_width(1)))?;
        }
        area.draw(&Circle::new((x + 18, y), 4, WHITE.filled()))?;
        area.draw(&Circle::new((x + 18, y), 4, GREY.stroke_width(1)))?;
        area.draw(&Text::new("paper", (x + 46, y), style()))?;
        y += 21;
    }
    if ideal {
        area.draw(&PathElement::new([(x, y), (x + 36, y)], PALE.stroke_width(1)))?;
        area.draw(&Text::new("ideal", (x + 46, y), style()))?;
    }
    Ok(())
}

/// Colours come again after the last: names at the lines' ends still tell them apart.
fn colour(index: usize) -> RGBColor {
    COLOURS[index % COLOURS.len()]
}

fn font(size: u32) -> TextStyle<'static> {
    ("sans-serif", size).into_font().into()
}

/// A column's name for people.
fn label(column: &str) -> String {
    match column {
        "time_s" => "Time (s)".to_owned(),
        "speed_up" => "Speed-up".to_owned(),
        other => {
            let words = other.replace(['_', '.'], " ");
            let mut letters = words.chars();
            letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
        }
    }
}
