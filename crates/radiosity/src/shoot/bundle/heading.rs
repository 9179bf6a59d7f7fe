//! The heading of rays along an axis: up, down or level.

use super::rays::Rays;

/// How a ray runs along an axis.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Heading {
    Down,
    /// Perpendicular to the axis.
    Level,
    Up,
}

impl Heading {
    /// The headings of the first of some rays on all axes, and the rays that share them.
    pub(crate) fn of_first(rays: &Rays, among: u64) -> ([Heading; 3], u64) {
        let first = among & among.wrapping_neg();
        let mut headings = [Heading::Level; 3];
        let mut alike = among;
        for (axis, heading) in headings.iter_mut().enumerate() {
            let (up, level) = (rays.up[axis], rays.level[axis]);
            let (first_heading, same) = if level & first != 0 {
                (Heading::Level, level)
            } else if up & first != 0 {
                (Heading::Up, up)
            } else {
                (Heading::Down, !up & !level)
            };
            *heading = first_heading;
            alike &= same;
        }
        (headings, alike)
    }
}
