//! How each line of a plot looks: colour, marker and dash. 24 lines are told apart, also without colours.

use plotters::style::RGBColor;

/// How many lines differ.
pub const STYLES: usize = COLOURS.len() * DASHES.len();

/// Okabe and Ito's colours, which colour-blind readers can tell apart. Yellow is too pale for lines on white: grey
/// stands for it. Their purple is darker here.
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(170, 90, 140),
    RGBColor(86, 180, 233),
    RGBColor(125, 125, 125),
    RGBColor(230, 159, 0),
    RGBColor(0, 0, 0),
];

/// Lengths drawn and left out in turn, pixels; none: a solid line.
const DASHES: [&[u32]; 3] = [&[], &[10, 5], &[3, 4]];

/// Dash of published figures, pixels.
pub const PUBLISHED: &[u32] = &[2, 3];

/// Lines from the first of one dash to the first of the next one: the markers are turned by as many.
const TURN: usize = 3;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Star,
    Nabla,
    Plus,
    Cross,
}

const MARKERS: [Marker; 8] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Star,
    Marker::Nabla,
    Marker::Plus,
    Marker::Cross,
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub colour: RGBColor,
    pub marker: Marker,
    pub dash: &'static [u32],
}

impl Style {
    /// The style of a line by its number; after [`STYLES`] they repeat.
    pub fn of(line: usize) -> Style {
        let group = line / COLOURS.len();
        Style {
            colour: COLOURS[line % COLOURS.len()],
            marker: MARKERS[(line + TURN * group) % MARKERS.len()],
            dash: DASHES[group % DASHES.len()],
        }
    }
}

impl Marker {
    /// Corners of the marker around a point; a circle has many. Markers of one radius look equally large.
    pub fn corners(self, (x, y): (i32, i32), radius: f64) -> Vec<(i32, i32)> {
        let at = |(right, up): (f64, f64)| {
            (x + (right * radius).round() as i32, y - (up * radius).round() as i32)
        };
        self.outline().into_iter().map(at).collect()
    }

    /// Corners around the origin, y upwards.
    fn outline(self) -> Vec<(f64, f64)> {
        let around = |corners: usize, radii: &[f64], first: f64| -> Vec<(f64, f64)> {
            let corner = |i: usize| {
                let angle = (first + i as f64 / corners as f64) * std::f64::consts::TAU;
                let radius = radii[i % radii.len()];
                (radius * angle.cos(), radius * angle.sin())
            };
            (0..corners).map(corner).collect()
        };
        const PLUS: [(f64, f64); 12] = {
            const W: f64 = 0.36;
            const L: f64 = 1.1;
            [
                (W, W),
                (L, W),
                (L, -W),
                (W, -W),
                (W, -L),
                (-W, -L),
                (-W, -W),
                (-L, -W),
                (-L, W),
                (-W, W),
                (-W, L),
                (W, L),
            ]
        };
        let turned = |(x, y): (f64, f64)| {
            let half = std::f64::consts::FRAC_1_SQRT_2;
            (half * (x - y), half * (x + y))
        };
        match self {
            Marker::Circle => around(24, &[1.0], 0.0),
            Marker::Square => around(4, &[1.25], 0.125),
            Marker::Triangle => around(3, &[1.4], 0.25),
            Marker::Nabla => around(3, &[1.4], 0.75),
            Marker::Diamond => around(4, &[1.35], 0.25),
            Marker::Star => around(10, &[1.5, 0.65], 0.25),
            Marker::Plus => PLUS.to_vec(),
            Marker::Cross => PLUS.into_iter().map(turned).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Any two of colour, marker and dash are enough: also for who sees no colours, and for points without lines.
    #[test]
    fn all_styles_differ_in_any_two_ways() {
        let styles: Vec<Style> = (0..STYLES).map(Style::of).collect();
        assert_eq!(STYLES, 24);
        let colour = |style: &Style| (style.colour.0, style.colour.1, style.colour.2);
        let marked: BTreeSet<_> = styles.iter().map(|s| (s.marker, s.dash)).collect();
        let coloured: BTreeSet<_> = styles.iter().map(|s| (colour(s), s.marker)).collect();
        let dashed: BTreeSet<_> = styles.iter().map(|s| (colour(s), s.dash)).collect();
        assert_eq!([marked.len(), coloured.len(), dashed.len()], [STYLES; 3]);
        assert_eq!(Style::of(STYLES).colour, Style::of(0).colour);
        assert!(styles.iter().all(|style| style.dash != PUBLISHED));
    }

    /// The contrast of WCAG 2, of graphics on white: 3 at least for the first six, 2 for all.
    #[test]
    fn colours_are_seen_on_white() {
        let part = |byte: u8| {
            let share = f64::from(byte) / 255.0;
            if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
        };
        for RGBColor(r, g, b) in COLOURS {
            let luminance = 0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b);
            assert!(1.05 / (luminance + 0.05) > 2.0, "{r} {g} {b}");
        }
    }
}
