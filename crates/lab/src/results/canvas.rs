//! The surface that plots are drawn on: an SVG file, through plotters.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::results::strokes::Spot;
use crate::results::style::Marker;

/// Drawing units per pixel: plotters rounds coordinates to whole units, which would be visible.
const FINE: u32 = 8;

pub const INK: RGBColor = RGBColor(40, 40, 40);
pub const GREY: RGBColor = RGBColor(120, 120, 120);
pub const PALE: RGBColor = RGBColor(190, 190, 190);
pub const GRID: RGBColor = RGBColor(232, 232, 232);

pub type Drawn = Result<(), Box<dyn std::error::Error>>;

pub struct Canvas<'a>(DrawingArea<SVGBackend<'a>, Shift>);

/// Drawing units of a length in pixels.
pub const fn px(pixels: u32) -> i32 {
    (pixels * FINE) as i32
}

/// Where text is from its point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Side {
    Right,
    Left,
    Below,
    /// Below, and turned to be read from the right.
    Hanging,
    /// Around it, and turned to be read from the right.
    Upright,
}

/// An SVG file of a size in pixels, on white, with what `draw` draws.
pub fn svg((width, height): (u32, u32), draw: impl FnOnce(&Canvas) -> Drawn) -> String {
    let mut text = String::new();
    let drawn = {
        let fine = (width * FINE, height * FINE);
        let canvas = Canvas(SVGBackend::with_string(&mut text, fine).into_drawing_area());
        canvas.0.fill(&WHITE).map_err(Into::into).and_then(|()| draw(&canvas))
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

impl Canvas<'_> {
    /// A line, as many pixels wide.
    pub fn line(&self, spots: impl Into<Vec<Spot>>, colour: RGBColor, pixels: f64) -> Drawn {
        let style = colour.stroke_width((pixels * f64::from(FINE)) as u32);
        Ok(self.0.draw(&PathElement::new(spots, style))?)
    }

    /// A filled area.
    pub fn fill(&self, corners: Vec<Spot>, colour: RGBColor, opacity: f64) -> Drawn {
        Ok(self.0.draw(&Polygon::new(corners, colour.mix(opacity).filled()))?)
    }

    /// A white rectangle between two corners.
    pub fn blank(&self, corners: [Spot; 2]) -> Drawn {
        Ok(self.0.draw(&Rectangle::new(corners, WHITE.filled()))?)
    }

    pub fn ring(&self, at: Spot, pixels: u32) -> Drawn {
        let style = INK.stroke_width(FINE);
        Ok(self.0.draw(&Circle::new(at, px(pixels), style))?)
    }

    /// A marker in its colour on a white rim, or hollow: white in its colour.
    pub fn marker(
        &self,
        marker: Marker,
        at: Spot,
        pixels: f64,
        colour: RGBColor,
        hollow: bool,
    ) -> Drawn {
        let radius = pixels * f64::from(FINE);
        let rim = f64::from(FINE);
        let (outer, inner) = if hollow { (colour, WHITE) } else { (WHITE, colour) };
        let shrunk = if hollow { (radius - 1.4 * rim).max(0.5 * rim) } else { radius };
        let grown = if hollow { radius } else { radius + rim };
        self.fill(marker.corners(at, grown), outer, 1.0)?;
        self.fill(marker.corners(at, shrunk), inner, 1.0)
    }

    pub fn dot(&self, at: Spot, pixels: u32, colour: RGBColor) -> Drawn {
        Ok(self.0.draw(&Circle::new(at, px(pixels), colour.filled()))?)
    }

    pub fn text(&self, text: &str, at: Spot, pixels: u32, colour: RGBColor, side: Side) -> Drawn {
        let (across, down) = match side {
            Side::Right => (HPos::Left, VPos::Center),
            Side::Left | Side::Hanging => (HPos::Right, VPos::Center),
            Side::Below => (HPos::Center, VPos::Top),
            Side::Upright => (HPos::Center, VPos::Center),
        };
        let font = ("sans-serif", px(pixels)).into_font();
        let turned = matches!(side, Side::Hanging | Side::Upright);
        let font = if turned { font.transform(FontTransform::Rotate270) } else { font };
        let style = font.color(&colour).pos(Pos::new(across, down));
        Ok(self.0.draw(&Text::new(text.to_owned(), at, style))?)
    }
}
