//! Writes the three scenes of RR-3008, section 5.1, as OBJ and MTL text.
//!
//! The paper prints counts and one sentence on each scene, not its geometry. Each module here draws
//! a place that fits the sentence and, once meshed, the counts. Lengths are whole millimetres until
//! they are printed in metres, z is up, and a polygon's front is the side from which its corners
//! run counter-clockwise. Every scene is closed: from inside a room no ray escapes, and none meets
//! the back of a polygon.

mod building;
mod furniture;
mod obj;
mod office;
mod palette;
mod rooms;
mod stream;

use std::{fmt, ops::RangeInclusive, str::FromStr};

pub use rooms::MOST_TABLES;

/// A scene of section 5.1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneKind {
    /// One open room with tables, chairs and shelves; two lights.
    Office,
    /// 32 equal rooms, each with four tables, four doors and one light.
    Rooms,
    /// Five unfurnished floors with one thousand lights.
    Building,
}

/// A scene as the text of its two files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneText {
    /// Name of the files.
    pub name: String,
    /// The OBJ file; it refers to `<name>.mtl`.
    pub obj: String,
    /// The MTL file: reflectance in `Kd`, emitted radiosity in W/m² in `Ke`.
    pub mtl: String,
}

/// Makes a scene. The same seed gives the same bytes.
///
/// The seed moves chairs in the office and walls in the building; the rooms are all alike, so there
/// it changes nothing. Counts of polygons and lights do not depend on it, except that the building's
/// windows follow its walls.
pub fn make(kind: SceneKind, seed: u64) -> SceneText {
    let obj = match kind {
        SceneKind::Office => office::draw(seed),
        SceneKind::Rooms => return make_rooms(rooms::TABLES, seed),
        SceneKind::Building => building::draw(building::FLOORS, seed),
    };
    obj.into_text(kind.name(), seed)
}

/// Makes the rooms with another number of tables in each, at most [`MOST_TABLES`]: the same walls and
/// doors with few polygons or many, to see what their number costs.
pub fn make_rooms(tables: u32, seed: u64) -> SceneText {
    rooms::draw(tables.min(MOST_TABLES)).into_text(SceneKind::Rooms.name(), seed)
}

/// Makes the building with another number of floors, with 200 lights on each; its files are called
/// `building-<floors>`. None beyond [`FLOORS`].
pub fn make_building(floors: u16, seed: u64) -> Option<SceneText> {
    let draw = || building::draw(floors, seed).into_text(&format!("building-{floors}"), seed);
    FLOORS.contains(&floors).then(draw)
}

/// How many floors a building may have: stairs lead from one to the next at least.
pub const FLOORS: RangeInclusive<u16> = 2..=1000;

impl SceneKind {
    /// The three scenes in the paper's order.
    pub const ALL: [SceneKind; 3] = [SceneKind::Office, SceneKind::Rooms, SceneKind::Building];

    /// Name of the scene and of its files.
    pub fn name(self) -> &'static str {
        match self {
            SceneKind::Office => "office",
            SceneKind::Rooms => "rooms",
            SceneKind::Building => "building",
        }
    }
}

impl fmt::Display for SceneKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is none of [`SceneKind::ALL`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownScene(String);

impl fmt::Display for UnknownScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no scene is called \"{}\": expected office, rooms or building", self.0)
    }
}

impl std::error::Error for UnknownScene {}

impl FromStr for SceneKind {
    type Err = UnknownScene;

    fn from_str(name: &str) -> Result<SceneKind, UnknownScene> {
        let known = SceneKind::ALL.into_iter().find(|kind| kind.name() == name);
        known.ok_or_else(|| UnknownScene(name.to_owned()))
    }
}
