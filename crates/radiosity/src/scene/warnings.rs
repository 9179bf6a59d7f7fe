//! What cleaning a scene dropped, changed or made up: counted, never silent.

use std::collections::BTreeMap;
use std::fmt;

/// Something odd about a face or a file that can be mended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WarningKind {
    /// A material file cannot be read; its materials are missing.
    MissingMaterialFile,
    /// A material without a reflectance (`Kd`): takes the default.
    MissingReflectance,
    /// A face without a material, or with one that no material file defines: takes the default.
    MissingMaterial,
    /// A face of fewer than three distinct corners, or without area: dropped.
    ZeroArea,
    /// A face whose corners do not lie in a plane: cut into triangles.
    NonPlanar,
    /// A planar face that is not convex: cut into triangles.
    Concave,
    /// A face whose boundary crosses itself: cut into triangles that may not cover what was meant.
    SelfCrossing,
    /// A face that repeats another one, corners and side alike: dropped.
    Duplicate,
}

/// How often one kind of trouble was met, and where first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// What was met.
    pub kind: WarningKind,
    /// How many times.
    pub count: usize,
    /// The first place.
    pub first: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (noun, what) = match self.kind {
            WarningKind::MissingMaterialFile => ("material file", "not read"),
            WarningKind::MissingReflectance => ("material", "without Kd: default grey taken"),
            WarningKind::MissingMaterial => ("face", "without a material: default grey taken"),
            WarningKind::ZeroArea => ("face", "without area dropped"),
            WarningKind::NonPlanar => ("non-planar face", "cut into triangles"),
            WarningKind::Concave => ("concave face", "cut into triangles"),
            WarningKind::SelfCrossing => ("face", "with a boundary that crosses itself"),
            WarningKind::Duplicate => ("duplicated face", "dropped"),
        };
        let plural = if self.count == 1 { "" } else { "s" };
        write!(f, "{} {noun}{plural} {what} (first: {})", self.count, self.first)
    }
}

/// Warnings of a scene, at most one of each kind, in the order of the kinds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings(BTreeMap<WarningKind, Warning>);

impl Warnings {
    /// Counts one more; the place is asked for only the first time.
    pub fn add(&mut self, kind: WarningKind, place: impl FnOnce() -> String) {
        let warning =
            self.0.entry(kind).or_insert_with(|| Warning { kind, count: 0, first: place() });
        warning.count += 1;
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Warning> {
        self.0.values()
    }

    /// How often this was met.
    pub fn count(&self, kind: WarningKind) -> usize {
        self.0.get(&kind).map_or(0, |w| w.count)
    }

    /// Whether there was nothing odd.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// These and the others' counts; the place of a kind met in both is this one's.
    pub fn and(mut self, others: Warnings) -> Warnings {
        for (kind, other) in others.0 {
            self.0.entry(kind).and_modify(|w| w.count += other.count).or_insert(other);
        }
        self
    }
}
