//! Plots as SVG, through plotters. Simulated figures are solid lines with filled markers, the
//! paper's are dashed lines with hollow markers of the same colour.

use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::experiment::fields::Plot;
use crate::results::power_law::PowerLaw;
use crate::results::scale::Scale;
use crate::results::series::{Drawing, Series};
use crate::table::measure::Measure;
use crate::table::runs_csv::Table;

/// Drawing units per pixel: plotters rounds coordinates to whole units, which would be visible.
const FINE: u32 = 8;
/// Width of a plot without the names of its lines, and its least height, pixels.
const SIZE: (u32, u32) = (670, 540);
/// Height of a line's name, and about the width of one of its letters, pixels.
const LETTER: (u32, u32) = (8, 17);
/// Above and below the axes, pixels.
const HEAD: u32 = 68;
const FOOT: u32 = 62;

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
    let (width, height) = size(&drawing);
    let drawn = {
        let fine = (width * FINE, height * FINE);
        let area = SVGBackend::with_string(&mut text, fine).into_drawing_area();
        draw(&area, &drawing, plot)
    };
    // Shown in its size in pixels: the view box keeps the finer units.
    let [fine, pixels] =
        [FINE, 1].map(|unit| format!("width=\"{}\" height=\"{}\"", width * unit, height * unit));
    match drawn {
        Ok(()) => text.replacen(&fine, &pixels, 1),
        // Drawing to memory does not fail. If it should, the file says so.
        Err(error) => {
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><desc>{error}</desc></svg>")
        }
    }
}

/// Width and height, pixels: with room for the longest name of a line, and for all of them.
fn size(drawing: &Drawing) -> (u32, u32) {
    let longest = drawing.series.iter().map(|series| series.name.chars().count()).max();
    let width = SIZE.0 + 30 + LETTER.0 * longest.unwrap_or(0).min(100) as u32;
    let names = drawing.series.len().min(1000) as u32 * LETTER.1;
    (width, SIZE.1.max(HEAD + FOOT + names))
}

/// Drawing units of a length in pixels.
const fn px(pixels: u32) -> i32 {
    (pixels * FINE) as i32
}

fn draw(area: &Area, drawing: &Drawing, plot: &Plot) -> Drawn {
    let (x, y) = (Measure::of(&plot.x), Measure::of(&plot.y));
    let title = || format!("{} by {}", y.words(), x.words().to_lowercase());
    let title = plot.title.clone().unwrap_or_else(title);
    area.fill(&WHITE)?;
    area.draw(&Text::new(title, (px(24), px(18)), font(19, INK)))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(px(HEAD))
        .margin_right(px(size(drawing).0 - SIZE.0))
        .margin_bottom(px(14))
        .margin_left(px(14))
        .x_label_area_size(px(FOOT - 14))
        .y_label_area_size(px(62))
        .build_cartesian_2d(x_scale(drawing, plot), y_scale(drawing, plot))?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .bold_line_style(line(GRID, 1))
        .light_line_style(TRANSPARENT)
        .axis_style(line(PALE, 1))
        .set_all_tick_mark_size(px(5))
        .label_style(font(14, INK))
        .axis_desc_style(font(15, INK))
        .x_desc(x.with_unit(&drawing.unit))
        .y_desc(y.with_unit(&drawing.unit_up))
        .draw()?;
    let ideal = plot.x == "processors" && plot.y == "speed_up";
    if ideal {
        draw_ideal(&mut chart)?;
    }
    for (i, series) in drawing.series.iter().enumerate() {
        draw_series(&mut chart, series, colour(i))?;
    }
    draw_names(area, &chart, drawing)?;
    draw_key(area, &chart, drawing, ideal, plot.mark_name.as_deref().unwrap_or("marked"))
}

fn x_scale(drawing: &Drawing, plot: &Plot) -> Scale {
    let values = drawing.points().map(|(x, _)| x);
    let scale = match plot.logarithmic()[0] {
        _ if !drawing.categories.is_empty() => return Scale::names(&drawing.categories),
        true => Scale::logarithmic(values.clone()),
        false => Scale::linear(values.clone()),
    };
    // Figures of runs are no round numbers.
    if drawing.swept { scale.ticked_at(values) } else { scale }
}

fn y_scale(drawing: &Drawing, plot: &Plot) -> Scale {
    let values = drawing.points().map(|(_, y)| y);
    if plot.logarithmic()[1] { Scale::logarithmic(values) } else { Scale::linear(values) }
}

/// The speed-up that equals the number of processors.
fn draw_ideal(chart: &mut Chart) -> Drawn {
    let (x, y) = (chart.x_range(), chart.y_range());
    let (from, to) = (x.start.max(y.start), x.end.min(y.end));
    chart.draw_series(LineSeries::new([(from, from), (to, to)], line(PALE, 1)))?;
    Ok(())
}

fn draw_series(chart: &mut Chart, series: &Series, colour: RGBColor) -> Drawn {
    let paper = series.paper.iter().copied();
    let dashes = DashedLineSeries::new(paper.clone(), px(6), px(4), line(colour, 1));
    chart.draw_series(dashes)?;
    let simulated = series.simulated.iter().copied();
    // A law is straight between its ends: both axes are logarithmic.
    let through = |law: PowerLaw| simulated.clone().map(move |(x, _)| (x, law.at(x))).collect();
    let joined = || series.front.clone().unwrap_or_else(|| simulated.clone().collect());
    let points: Vec<_> = series.law.map_or_else(joined, through);
    chart.draw_series(LineSeries::new(points, line(colour, 2)))?;
    chart.draw_series(paper.clone().map(|at| Circle::new(at, px(4), WHITE.filled())))?;
    // A single point, where the two should agree, would hide behind ours: a ring around it.
    let radius = if series.paper.len() == 1 { px(8) } else { px(4) };
    chart.draw_series(paper.map(|at| Circle::new(at, radius, line(colour, 1))))?;
    let size = |at: &(f64, f64)| match &series.front {
        Some(front) if !front.contains(at) => px(2),
        _ => px(4),
    };
    chart.draw_series(simulated.map(|at| Circle::new(at, size(&at), colour.filled())))?;
    for radius in [px(8), px(9)] {
        let marked = series.marked.iter().copied();
        chart.draw_series(marked.map(|at| Circle::new(at, radius, line(INK, 1))))?;
    }
    Ok(())
}

/// Each line's name at its right end, moved apart where two would overlap.
fn draw_names(area: &Area, chart: &Chart, drawing: &Drawing) -> Drawn {
    let ends = drawing.series.iter().enumerate().filter(|(_, series)| !series.name.is_empty());
    let mut ends: Vec<(i32, usize)> = ends
        .filter_map(|(i, series)| {
            let end = series.simulated.last().or(series.paper.last())?;
            Some((chart.backend_coord(end).1, i))
        })
        .collect();
    ends.sort_unstable();
    let last = ends.len().saturating_sub(1) as i32;
    let (left, height) = (px(SIZE.0 + 12), px(LETTER.1));
    let bottom = px(size(drawing).1 - FOOT) - height * last;
    let mut free = i32::MIN;
    for (rank, (y, i)) in (0..).zip(ends) {
        let y = y.max(free).min(bottom + height * rank);
        free = y + height;
        let name = drawing.series[i].name.clone();
        area.draw(&Text::new(name, (left, y), beside(15, colour(i))))?;
    }
    Ok(())
}

/// What solid and dashed lines and rings mean, in a row above the axes, where no line can run.
fn draw_key(area: &Area, chart: &Chart, drawing: &Drawing, ideal: bool, marked: &str) -> Drawn {
    let mut x = chart.plotting_area().get_pixel_range().0.start;
    let y = px(HEAD - 15);
    let across = |x: i32, from: u32, to: u32| [(x + px(from), y), (x + px(to), y)];
    // Names an entry; says where the next one begins.
    let name = |x: i32, name: &str| -> Result<i32, Box<dyn std::error::Error>> {
        area.draw(&Text::new(name.to_owned(), (x + px(44), y), beside(14, INK)))?;
        Ok(x + px(68 + LETTER.0 * name.chars().count() as u32))
    };
    if drawing.series.iter().any(|series| !series.paper.is_empty()) {
        area.draw(&PathElement::new(across(x, 0, 36), line(GREY, 2)))?;
        area.draw(&Circle::new((x + px(18), y), px(4), GREY.filled()))?;
        x = name(x, "simulated")?;
        for dash in [0, 10, 20, 30] {
            area.draw(&PathElement::new(across(x, dash, dash + 6), line(GREY, 1)))?;
        }
        area.draw(&Circle::new((x + px(18), y), px(4), WHITE.filled()))?;
        area.draw(&Circle::new((x + px(18), y), px(4), line(GREY, 1)))?;
        x = name(x, drawing.publisher)?;
    }
    if ideal {
        area.draw(&PathElement::new(across(x, 0, 36), line(PALE, 1)))?;
        x = name(x, "ideal")?;
    }
    if drawing.series.iter().any(|series| !series.marked.is_empty()) {
        area.draw(&Circle::new((x + px(26), y), px(9), line(INK, 1)))?;
        name(x, marked)?;
    }
    Ok(())
}

/// Colours repeat after the last one; names at the lines' ends still distinguish lines.
fn colour(index: usize) -> RGBColor {
    COLOURS[index % COLOURS.len()]
}

fn line(colour: RGBColor, pixels: u32) -> ShapeStyle {
    colour.stroke_width(pixels * FINE)
}

fn font(pixels: u32, colour: RGBColor) -> TextStyle<'static> {
    ("sans-serif", px(pixels)).into_font().color(&colour)
}

/// Text that begins right of its point.
fn beside(pixels: u32, colour: RGBColor) -> TextStyle<'static> {
    font(pixels, colour).pos(Pos::new(HPos::Left, VPos::Center))
}
