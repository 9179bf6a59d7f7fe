//! Which way rays go along an axis.

use super::rays::Rays;

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    Down,
    /// At right angles to the axis.
    Level,
    Up,
}

impl Way {
    /// The ways of the first of some rays on all axes, and those of them that go the same ways.
    pub(crate) fn of_first(rays: &Rays, among: u64) -> ([Way; 3], u64) {
        let first = among & among.wrapping_neg();
        let mut ways = [Way::Level; 3];
        let mut alike = among;
        for (axis, way) in ways.iter_mut().enumerate() {
            let (up, level) = (rays.up[axis], rays.level[axis]);
            let (first_way, same) = if level & first != 0 {
                (Way::Level, level)
            } else if up & first != 0 {
                (Way::Up, up)
            } else {
                (Way::Down, !up & !level)
            };
            *way = first_way;
            alike &= same;
        }
        (ways, alike)
    }
}
