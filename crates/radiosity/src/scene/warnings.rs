//! Warnings about scene files: what was dropped, changed or replaced, with counts.

use std::collections::BTreeMap;
use std::fmt;

/// A problem in a face or a file that can be repaired.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum WarningKind {
    /// A material file cannot be read. Its materials are missing.
    MissingMaterialFile,
    /// A material without a reflectance (`Kd`): the default is used.
    MissingReflectance,
    /// A material with a texture (`map_Kd`), which is not read.
    Texture,
    /// A material with a texture of its emission (`map_Ke`), which is not read.
    EmissionTexture,
    /// A material that lets light through (`d`, `Tr`, `Tf`, `map_d`): opaque here.
    Transparency,
    /// A material with a reflectance above the limit that was asked for: lowered.
    Clamped,
    /// A face without a material, or with an undefined material: the default is used.
    MissingMaterial,
    /// A vertex with a fourth coordinate, the weight of a rational curve, that is not 1: ignored.
    Weight,
    /// A face with fewer than three distinct corners, or without area: dropped.
    ZeroArea,
    /// A face whose corners are not in one plane: divided into triangles.
    NonPlanar,
    /// A planar face that is not convex: divided into triangles.
    Concave,
    /// A face whose boundary crosses itself: divided into triangles, perhaps wrongly.
    SelfCrossing,
    /// A face with the same corners and the same front as another one: dropped.
    Duplicate,
    /// Two faces of one plane that face the same way and overlap: one of them is seen.
    Overlap,
}

/// How often one kind of problem occurred, and where first.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    /// Kind of problem.
    pub kind: WarningKind,
    /// Number of occurrences.
    pub count: usize,
    /// Place of the first occurrence.
    pub first: String,
    /// For overlaps: the area of all of them, m².
    pub area: f64,
}

impl Warning {
    fn add(&mut self, other: &Warning) {
        self.count += other.count;
        self.area += other.area;
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (noun, what) = match self.kind {
            WarningKind::MissingMaterialFile => ("material file", "not read"),
            WarningKind::MissingReflectance => ("material", "without Kd: default grey taken"),
            WarningKind::Texture => ("material", "with a texture (map_Kd), which is not read"),
            WarningKind::EmissionTexture => {
                ("material", "with a texture of emission (map_Ke), which is not read")
            }
            WarningKind::Transparency => ("transparent material", "taken as opaque"),
            WarningKind::Clamped => ("material", "with a clamped reflectance"),
            WarningKind::Weight => ("vertex", "with a fourth coordinate other than 1: ignored"),
            WarningKind::MissingMaterial => ("face", "without a material: default grey taken"),
            WarningKind::ZeroArea => ("face", "without area dropped"),
            WarningKind::NonPlanar => ("non-planar face", "cut into triangles"),
            WarningKind::Concave => ("concave face", "cut into triangles"),
            WarningKind::SelfCrossing => ("face", "with a boundary that crosses itself"),
            WarningKind::Duplicate => ("duplicated face", "dropped"),
            WarningKind::Overlap => ("overlap", "of faces in one plane"),
        };
        let nouns = match (self.count, noun) {
            (1, noun) => noun.to_owned(),
            (_, "vertex") => "vertices".to_owned(),
            (_, noun) => format!("{noun}s"),
        };
        if self.kind == WarningKind::Overlap {
            let seen = "a light is seen before other faces, then the smaller face";
            let area = match self.area {
                small if small < 0.01 => format!("{small:.1e}"),
                area => format!("{area:.4}"),
            };
            let what = format!("{what}, {area} m² in all: {seen}");
            return write!(f, "{} {nouns} {what} (first: {})", self.count, self.first);
        }
        write!(f, "{} {nouns} {what} (first: {})", self.count, self.first)
    }
}

/// Warnings of a scene: at most one of each kind, in the order of the kinds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Warnings(BTreeMap<WarningKind, Warning>);

impl Warnings {
    /// Counts one more occurrence. `place` is called only for the first one of a kind.
    pub fn add(&mut self, kind: WarningKind, place: impl FnOnce() -> String) {
        self.add_area(kind, 0.0, place);
    }

    /// The same for a problem with an area, m².
    pub fn add_area(&mut self, kind: WarningKind, area: f64, place: impl FnOnce() -> String) {
        let new = || Warning { kind, count: 0, first: place(), area: 0.0 };
        let warning = self.0.entry(kind).or_insert_with(new);
        warning.count += 1;
        warning.area += area;
    }

    /// All warnings.
    pub fn iter(&self) -> impl Iterator<Item = &Warning> {
        self.0.values()
    }

    /// Number of occurrences of a kind.
    pub fn count(&self, kind: WarningKind) -> usize {
        self.0.get(&kind).map_or(0, |w| w.count)
    }

    /// Whether there are no warnings.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds the counts of `others`. Of a kind in both, the place of `self` is kept.
    pub fn and(mut self, others: Warnings) -> Warnings {
        for (kind, other) in others.0 {
            self.0.entry(kind).and_modify(|w| w.add(&other)).or_insert(other);
        }
        self
    }
}
