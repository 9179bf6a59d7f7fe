//! Writes the three scenes of RR-3008, section 5.1, and small ones to compare methods on, as OBJ and
//! MTL text.
//!
//! The paper prints counts and one sentence on each scene, not its geometry. Each module here draws
//! a place that fits the sentence and, once meshed, the counts. Lengths are whole millimetres until
//! they are printed in metres, z is up, and a polygon's front is the side from which its corners
//! run counter-clockwise. Every scene but the Cornell box is closed: from inside a room no ray escapes, and none meets
//! the back of a polygon.

mod building;
mod furniture;
mod obj;
mod office;
mod palette;
mod rooms;
mod small;
mod stream;

use std::{fmt, ops::RangeInclusive, str::FromStr};

use obj::Obj;
pub use rooms::MOST_TABLES;

/// A scene of section 5.1, or a small one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneKind {
    /// One open room with tables, chairs and shelves; two lights.
    Office,
    /// 32 equal rooms, each with four tables, four doors and one light.
    Rooms,
    /// Five unfurnished floors with one thousand lights.
    Building,
    /// An empty room of 4 × 4 × 3 m.
    Room4,
    /// Two arms of a corridor, one lit.
    Corridor,
    /// Two rooms, one lit, and a hole of one patch between them.
    Hole,
    /// The Cornell box.
    Cornell,
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
/// The seed moves chairs in the office and walls in the building; elsewhere it changes nothing. Counts of polygons and lights do not depend on it, except that the building's
/// windows follow its walls.
pub fn make(kind: SceneKind, seed: u64) -> SceneText {
    let obj = match kind {
        SceneKind::Office => office::draw(seed),
        SceneKind::Rooms => return make_rooms(rooms::TABLES, seed),
        SceneKind::Building => building::draw(building::FLOORS, seed),
        SceneKind::Room4 => small::room4(),
        SceneKind::Corridor => small::corridor(),
        SceneKind::Hole => small::hole(),
        SceneKind::Cornell => small::cornell(),
    };
    match SceneKind::PAPER.contains(&kind) {
        true => of_the_paper(obj, kind.name(), seed),
        false => obj.into_text(kind.name(), &format!("{kind}: a small scene")),
    }
}

fn of_the_paper(obj: Obj, name: &str, seed: u64) -> SceneText {
    obj.into_text(name, &format!("{name}, seed {seed}: a scene of RR-3008, section 5.1"))
}

/// Makes the rooms with another number of tables in each, at most [`MOST_TABLES`]: the same walls and
/// doors with few polygons or many, to see what their number costs.
pub fn make_rooms(tables: u32, seed: u64) -> SceneText {
    of_the_paper(rooms::draw(tables.min(MOST_TABLES)), SceneKind::Rooms.name(), seed)
}

/// Makes the building with another number of floors, with 200 lights on each; its files are called
/// `building-<floors>`. None beyond [`FLOORS`].
pub fn make_building(floors: u16, seed: u64) -> Option<SceneText> {
    let draw = || of_the_paper(building::draw(floors, seed), &format!("building-{floors}"), seed);
    FLOORS.contains(&floors).then(draw)
}

/// How many floors a building may have: stairs lead from one to the next at least.
pub const FLOORS: RangeInclusive<u16> = 2..=1000;

impl SceneKind {
    /// The three scenes in the paper's order.
    pub const PAPER: [SceneKind; 3] = [SceneKind::Office, SceneKind::Rooms, SceneKind::Building];

    /// The small scenes.
    pub const SMALL: [SceneKind; 4] =
        [SceneKind::Room4, SceneKind::Corridor, SceneKind::Hole, SceneKind::Cornell];

    /// All scenes.
    pub fn all() -> impl Iterator<Item = SceneKind> {
        SceneKind::PAPER.into_iter().chain(SceneKind::SMALL)
    }

    /// Name of the scene and of its files.
    pub fn name(self) -> &'static str {
        match self {
            SceneKind::Office => "office",
            SceneKind::Rooms => "rooms",
            SceneKind::Building => "building",
            SceneKind::Room4 => "room4",
            SceneKind::Corridor => "corridor",
            SceneKind::Hole => "hole",
            SceneKind::Cornell => "cornell",
        }
    }
}

impl fmt::Display for SceneKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is none of [`SceneKind::all`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownScene(String);

impl fmt::Display for UnknownScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = SceneKind::all().map(SceneKind::name).collect();
        write!(f, "no scene is called \"{}\": expected one of {}", self.0, names.join(", "))
    }
}

impl std::error::Error for UnknownScene {}

impl FromStr for SceneKind {
    type Err = UnknownScene;

    fn from_str(name: &str) -> Result<SceneKind, UnknownScene> {
        let known = SceneKind::all().find(|kind| kind.name() == name);
        known.ok_or_else(|| UnknownScene(name.to_owned()))
    }
}
