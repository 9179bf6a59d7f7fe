//! Makes scenes by kind.

use std::ops::RangeInclusive;

use crate::kind::SceneKind;
use crate::obj::{Obj, SceneText};
use crate::rooms::{self, MOST_TABLES};
use crate::{building, office, small};

/// Makes a scene. The same seed gives the same bytes.
///
/// The seed moves chairs in the office and walls, with their windows, in the building. Otherwise
/// the numbers of polygons and lights do not depend on it.
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

/// The text of a scene of the paper.
fn of_the_paper(obj: Obj, name: &str, seed: u64) -> SceneText {
    obj.into_text(name, &format!("{name}, seed {seed}: a scene of RR-3008, section 5.1"))
}

/// Makes the rooms with another number of tables in each, at most [`MOST_TABLES`]: the same walls
/// and doors with few or many polygons, to measure the cost of polygons.
pub fn make_rooms(tables: u32, seed: u64) -> SceneText {
    of_the_paper(rooms::draw(tables.min(MOST_TABLES)), SceneKind::Rooms.name(), seed)
}

/// Makes the building with another number of floors and 200 lights per floor. Its files are named
/// `building-<floors>`. `None` if the number is not in [`FLOORS`].
pub fn make_building(floors: u16, seed: u64) -> Option<SceneText> {
    let draw = || of_the_paper(building::draw(floors, seed), &format!("building-{floors}"), seed);
    FLOORS.contains(&floors).then(draw)
}

/// Possible numbers of floors of a building. Stairs need at least two.
pub const FLOORS: RangeInclusive<u16> = 2..=1000;
