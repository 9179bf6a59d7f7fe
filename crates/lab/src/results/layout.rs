//! Where the parts of a plot are, pixels.

use crate::results::canvas::px;
use crate::results::series::Drawing;
use crate::results::strokes::Spot;

/// Height of a line's name, and about the width of one of its letters.
pub const LETTER: (u32, u32) = (8, 18);
/// From the left edge to the axes, and from the axes to the lower edge.
const LEFT: u32 = 80;
const FOOT: u32 = 62;
/// Above the axes: title, and a row that explains the marks.
pub const HEAD: u32 = 68;
/// Sizes of the axes of a single panel, and of one among several.
const SINGLE: (u32, u32) = (590, 410);
const SMALL: (u32, u32) = (280, 240);
/// Between panels: beside each other, and below each other with a name.
const GAP: (u32, u32) = (20, 38);
/// From the axes to the names of the lines, with room for leaders.
const LEADERS: u32 = 36;
/// A line's sample before its name.
pub const SAMPLE: u32 = 40;
/// The most letters of a name that are written.
const MOST: usize = 100;

/// The axes of a panel: the rectangle that points are in, drawing units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

pub struct Layout {
    /// Of the whole figure.
    pub size: (u32, u32),
    /// Panels beside each other.
    columns: u32,
    panels: u32,
    panel: (u32, u32),
    foot: u32,
    /// Whether names along the horizontal axis are turned, for want of room.
    pub turned: bool,
}

impl Layout {
    /// The layout of a drawing with a line of text of this many letters above the axes.
    pub fn of(drawing: &Drawing, letters: usize) -> Layout {
        let panels = drawing.panels.len() as u32;
        let columns = match panels {
            ..=3 => panels,
            4 => 2,
            _ => 3,
        };
        let panel = if panels == 1 { SINGLE } else { SMALL };
        let longest = |names: &[String]| {
            names.iter().map(|name| name.chars().count()).max().unwrap_or(0).min(MOST) as u32
        };
        let law = drawing.series_of_all().any(|series| panels == 1 && series.law.is_some());
        let names = longest(&drawing.names) + if law { 26 } else { 0 };
        let names = if names == 0 { 24 } else { LEADERS + SAMPLE + 16 + LETTER.0 * names };
        let ticks = longest(&drawing.categories);
        let turned = LETTER.0 * ticks * drawing.categories.len() as u32 > panel.0;
        let foot = FOOT + if turned { LETTER.0 * ticks } else { 0 };
        let axes = (
            columns * (panel.0 + GAP.0) - GAP.0,
            panels.div_ceil(columns) * (panel.1 + GAP.1) - GAP.1,
        );
        let head = HEAD + if panels == 1 { 0 } else { GAP.1 - 12 };
        let lines = drawing.names.len().min(1_000) as u32 * LETTER.1;
        let width = (LEFT + axes.0 + names).max(48 + 10 * letters.min(150) as u32);
        let size = (width, head + foot + axes.1.max(lines));
        Layout { size, columns, panels, panel, foot, turned }
    }

    pub fn is_single(&self) -> bool {
        self.panels == 1
    }

    pub fn frame(&self, panel: usize) -> Frame {
        let (column, row) = (panel as u32 % self.columns, panel as u32 / self.columns);
        let head = HEAD + if self.is_single() { 0 } else { GAP.1 - 12 };
        let left = px(LEFT + column * (self.panel.0 + GAP.0));
        let top = px(head + row * (self.panel.1 + GAP.1));
        Frame { left, top, right: left + px(self.panel.0), bottom: top + px(self.panel.1) }
    }

    /// Whether a panel has no other at its left, and none below it: there the axes have numbers.
    pub fn has_numbers(&self, panel: usize) -> [bool; 2] {
        [panel as u32 + self.columns >= self.panels, (panel as u32).is_multiple_of(self.columns)]
    }

    /// The name of a panel, as far as there is room for it.
    pub fn panel_name(&self, name: &str) -> String {
        last_letters(name, (self.panel.0 / LETTER.0) as usize)
    }

    /// All panels together.
    pub fn whole(&self) -> Frame {
        let (first, last) = (self.frame(0), self.frame(self.panels as usize - 1));
        let right = first.left + px(self.columns * (self.panel.0 + GAP.0) - GAP.0);
        Frame { right, bottom: last.bottom, ..first }
    }

    /// Where the title of the horizontal axis is.
    pub fn below_numbers(&self) -> i32 {
        self.whole().bottom + px(self.foot - 28)
    }

    /// Where the column of names begins.
    pub fn names(&self) -> i32 {
        self.whole().right + px(LEADERS)
    }
}

impl Frame {
    pub fn middle(&self) -> Spot {
        ((self.left + self.right) / 2, (self.top + self.bottom) / 2)
    }
}

/// The name of a line, or of a place along the horizontal axis, as far as it is written.
pub fn line_name(name: &str) -> String {
    last_letters(name, MOST)
}

/// The last letters of a text that is longer: names of files differ there.
fn last_letters(text: &str, most: usize) -> String {
    let letters = text.chars().count();
    if letters <= most {
        return text.to_owned();
    }
    let last = text.chars().skip(letters + 1 - most);
    std::iter::once('…').chain(last).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_keep_their_ends() {
        assert_eq!(last_letters("abc", 3), "abc");
        assert_eq!(last_letters("abcd", 3), "…cd");
    }
}
