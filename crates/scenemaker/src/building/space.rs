//! The spaces of one storey and the openings between them.

use crate::obj::{
    Cuboid,
    Facing::{self, Down, East, North, South, Up, West},
    Obj, Opening, Span,
};
use crate::palette::{
    BLUE_WALL, BRICK, CARPET, CEILING, CONCRETE, FRAME, GLASS, GREEN_WALL, Material, STONE, WALL,
    WARM_WALL, WOOD_FLOOR,
};

use super::{CLEAR, SIZE, STOREY, elevation};

/// Width of a window, mm.
const WINDOW: i32 = 1000;
/// Least distance from the middle of a window to the next, mm.
const WINDOW_PITCH: i32 = 1500;
/// A window's sill and head above the floor, mm.
const WINDOW_Z: Span = [900, 2400];

/// What a space is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// A room for one or two.
    Office,
    /// A room for some six.
    Shared,
    /// A seminar room.
    Seminar,
    /// A laboratory or a lecture hall.
    Lab,
    /// A corridor.
    Corridor,
    /// A stair well, open to the floors above and below.
    Stairs,
    /// The hall through all floors.
    Atrium,
}

impl Use {
    /// What a room of that area (m²) serves for.
    pub fn of_room(area: f64) -> Use {
        match area {
            ..20.0 => Use::Office,
            ..36.0 => Use::Shared,
            ..60.0 => Use::Seminar,
            _ => Use::Lab,
        }
    }

    /// Whether floors and ceilings leave it open.
    pub fn is_shaft(self) -> bool {
        matches!(self, Use::Stairs | Use::Atrium)
    }

    fn name(self) -> &'static str {
        match self {
            Use::Office => "office",
            Use::Shared => "shared office",
            Use::Seminar => "seminar room",
            Use::Lab => "laboratory",
            Use::Corridor => "corridor",
            Use::Stairs => "stair well",
            Use::Atrium => "atrium",
        }
    }

    /// Materials of floor and walls.
    fn finish(self, level: usize) -> [&'static Material; 2] {
        const CORRIDORS: [&Material; 5] =
            [&WARM_WALL, &GREEN_WALL, &WARM_WALL, &BLUE_WALL, &GREEN_WALL];
        match self {
            Use::Office => [&CARPET, &WALL],
            Use::Shared => [&CARPET, &BLUE_WALL],
            Use::Seminar => [&WOOD_FLOOR, &WARM_WALL],
            Use::Lab => [&WOOD_FLOOR, &WALL],
            Use::Corridor => [&STONE, CORRIDORS[level % CORRIDORS.len()]],
            Use::Stairs => [&CONCRETE, &WALL],
            Use::Atrium => [&STONE, &BRICK],
        }
    }
}

/// A hollow box: a room, a corridor, or one storey of a shaft.
pub struct Space {
    /// What it is for.
    pub usage: Use,
    /// Between its walls, floor and ceiling.
    pub hollow: Cuboid,
    number: usize,
    /// Holes in its walls, each with the side that it is in.
    holes: Vec<(Facing, Opening)>,
    /// Walls that its doors lead through: the side, the wall's extent on that axis, the opening.
    linings: Vec<(Facing, Span, Opening)>,
}

/// One storey.
pub struct Plan {
    /// Counted from 0.
    pub level: usize,
    /// Whether no storey lies above it.
    pub uppermost: bool,
    /// In the order of their numbers.
    pub spaces: Vec<Space>,
}

impl Plan {
    /// A storey without spaces, of a building of so many floors.
    pub fn new(level: usize, floors: usize) -> Plan {
        Plan { level, uppermost: level + 1 == floors, spaces: Vec::new() }
    }

    /// Elevation of the floor, mm.
    pub fn floor(&self) -> i32 {
        elevation(self.level)
    }

    /// From floor to ceiling.
    pub fn clear(&self) -> Span {
        [self.floor(), self.floor() + CLEAR]
    }

    /// Adds a space and returns its index.
    pub fn add(&mut self, usage: Use, x: Span, y: Span) -> usize {
        let number = self.spaces.len() + 1;
        // Shafts reach up to the floor above, rooms to their ceiling.
        let open_above = usage.is_shaft() && !self.uppermost;
        let height = if open_above { STOREY } else { CLEAR };
        let hollow = Cuboid { x, y, z: [self.floor(), self.floor() + height] };
        let space = Space { usage, hollow, number, holes: Vec::new(), linings: Vec::new() };
        self.spaces.push(space);
        self.spaces.len() - 1
    }

    /// Opens the wall on that side of space `a` towards space `b`, which lies behind it.
    pub fn join(&mut self, a: usize, side: Facing, b: usize, opening: Opening) {
        // Both walls, seen from inside their spaces, lie where they face each other's way.
        let near = self.spaces[a].hollow.outer(side).at;
        let far = self.spaces[b].hollow.outer(side.opposite()).at;
        self.spaces[a].holes.push((side, opening));
        self.spaces[b].holes.push((side.opposite(), opening));
        if near != far {
            let depth = [near.min(far), near.max(far)];
            self.spaces[a].linings.push((side, depth, opening));
        }
    }

    /// Draws every space.
    pub fn draw(&self, obj: &mut Obj) {
        for space in &self.spaces {
            let number = 100 * (self.level + 1) + space.number;
            obj.object(format_args!("{} {number}", space.usage.name()));
            space.draw(obj, self.level);
        }
    }
}

impl Space {
    fn draw(&self, obj: &mut Obj, level: usize) {
        let [floor, paint] = self.usage.finish(level);
        let bottom = level == 0 || !self.usage.is_shaft();
        let top = self.hollow.z[1] == elevation(level) + CLEAR;
        if bottom {
            obj.rect(floor, self.hollow.inner(Up));
        }
        if top {
            obj.rect(&CEILING, self.hollow.inner(Down));
        }
        for side in Facing::SIDES {
            self.draw_side(obj, paint, side);
        }
        for &(side, depth, opening) in &self.linings {
            let sill = if opening.z[0] == self.hollow.z[0] { floor } else { &FRAME };
            obj.reveal(&FRAME, Some(sill), side, depth, opening);
        }
    }

    /// A wall with its doors, or windows where it is an outer one.
    fn draw_side(&self, obj: &mut Obj, paint: &'static Material, side: Facing) {
        let inward = side.opposite();
        let wall = self.hollow.inner(inward);
        let mut holes: Vec<Opening> =
            self.holes.iter().filter(|hole| hole.0 == side).map(|hole| hole.1).collect();
        if let Some(glass) = outer_face(side, wall.at) {
            holes = windows(wall.u, self.hollow.z[0]);
            let depth = [glass.min(wall.at), glass.max(wall.at)];
            for &window in &holes {
                obj.recess([&FRAME, &GLASS], Some(&FRAME), inward, depth, window);
            }
        }
        holes.sort_by_key(|hole| hole.along);
        obj.wall(paint, wall, &holes);
    }
}

/// Where the glass stands in a wall on that side, if it is an outer wall.
fn outer_face(side: Facing, at: i32) -> Option<i32> {
    let glass = match side {
        West | South => 0,
        East => SIZE[0],
        North => SIZE[1],
        Up | Down => return None,
    };
    ((at - glass).abs() == super::WALL).then_some(glass)
}

/// As many windows as fit the wall, evenly.
fn windows([from, to]: Span, floor: i32) -> Vec<Opening> {
    let count = ((to - from) / WINDOW_PITCH).max(1);
    let middle = |i: i32| from + (to - from) * (2 * i + 1) / (2 * count);
    let z = WINDOW_Z.map(|z| floor + z);
    let window = |i: i32| Opening { along: [middle(i) - WINDOW / 2, middle(i) + WINDOW / 2], z };
    (0..count).map(window).collect()
}
