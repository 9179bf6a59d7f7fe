//! Axis-aligned boxes.

use glam::DVec3;

/// An axis-aligned box. It is empty when a minimum exceeds its maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Corner with the smallest coordinates.
    pub min: DVec3,
    /// Corner with the largest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The empty box.
    pub const EMPTY: Bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box that contains the points.
    pub fn of(points: impl IntoIterator<Item = DVec3>) -> Bounds {
        points
            .into_iter()
            .fold(Bounds::EMPTY, |b, p| Bounds { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The same box, larger by `by` on every side.
    pub fn widened(&self, by: f64) -> Bounds {
        Bounds { min: self.min - by, max: self.max + by }
    }

    /// The part of space inside both boxes.
    pub fn intersection(&self, other: &Bounds) -> Bounds {
        Bounds { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// The smallest box that contains both.
    pub fn union(&self, other: &Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Edge lengths.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }
}
