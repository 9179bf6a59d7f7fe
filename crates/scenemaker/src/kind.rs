//! The kinds of scene that can be made, by name.

use std::{fmt, str::FromStr};

/// A scene of §5.1, or a small test scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneKind {
    /// One open room with tables, chairs, shelves and two lights.
    Office,
    /// 32 equal rooms, each with four tables, four doors and one light.
    Rooms,
    /// Five unfurnished floors with one thousand lights.
    Building,
    /// An empty room of 4 × 4 × 3 m.
    Room4,
    /// A corridor with two arms, one of them lit.
    Corridor,
    /// Two rooms, one of them lit, with a hole of one patch between them.
    Hole,
    /// The Cornell box.
    Cornell,
}

impl SceneKind {
    /// The three scenes of the paper, in its order.
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

/// A name that no scene has.
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
