//! Axes of a panel: grid, ticks and numbers.

use crate::results::canvas::{Canvas, Drawn, GRID, INK, PALE, Side, px};
use crate::results::layout::{Frame, line_name};
use crate::results::scale::Scale;
use crate::results::strokes::Spot;

/// Size of numbers, and about the width of one of their letters, pixels.
const NUMBERS: (u32, i32) = (14, px(8));

/// Both axes of a panel.
pub struct Axes<'a> {
    pub frame: Frame,
    pub x: &'a Scale,
    pub y: &'a Scale,
}

impl Axes<'_> {
    pub fn spot(&self, (x, y): (f64, f64)) -> Spot {
        (self.across(x), self.up(y))
    }

    fn across(&self, x: f64) -> i32 {
        self.x.place(x, self.frame.left, self.frame.right)
    }

    fn up(&self, y: f64) -> i32 {
        self.y.place(y, self.frame.bottom, self.frame.top)
    }

    /// The place inside the axes that is nearest to a point.
    pub fn clamped(&self, (x, y): (f64, f64)) -> Spot {
        let Frame { left, top, right, bottom } = self.frame;
        (self.across(x).clamp(left, right), self.up(y).clamp(top, bottom))
    }

    /// Draws them, with numbers where they are wanted: along x, along y. `turned` turns those along x.
    pub fn draw(&self, canvas: &Canvas, numbers: [bool; 2], turned: bool) -> Drawn {
        let Frame { left, top, right, bottom } = self.frame;
        for &tick in self.y.ticks() {
            let y = self.up(tick);
            canvas.line([(left, y), (right, y)], GRID, 1.0)?;
            canvas.line([(left - px(5), y), (left, y)], PALE, 1.0)?;
            if numbers[1] {
                let text = self.y.text(tick);
                canvas.text(&text, (left - px(9), y), NUMBERS.0, INK, Side::Left)?;
            }
        }
        canvas.line([(left, top), (left, bottom), (right, bottom)], PALE, 1.0)?;
        let mut free = i32::MIN;
        for &tick in self.x.ticks() {
            let (x, text) = (self.across(tick), line_name(&self.x.text(tick)));
            canvas.line([(x, bottom), (x, bottom + px(5))], PALE, 1.0)?;
            let width = if turned { NUMBERS.1 } else { NUMBERS.1 * text.chars().count() as i32 };
            if numbers[0] && x - width / 2 >= free {
                free = x + width / 2;
                let side = if turned { Side::Hanging } else { Side::Below };
                canvas.text(&text, (x, bottom + px(9)), NUMBERS.0, INK, side)?;
            }
        }
        Ok(())
    }
}
