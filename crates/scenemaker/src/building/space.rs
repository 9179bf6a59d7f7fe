//! The spaces of one storey and the openings between them.

use crate::obj::Obj;
use crate::palette::{
    BLUE_WALL, BRICK, CARPET, CEILING, CONCRETE, FRAME, GLASS, GREEN_WALL, Material, STONE, WALL,
    WARM_WALL, WOOD_FLOOR,
};
use crate::shapes::{
    Cuboid,
    Facing::{self, Down, East, North, South, Up, West},
    Opening, Span,
};

use super::dimensions::{CLEAR, SIZE, STOREY, elevation};

/// Width of a window, mm.
const WINDOW: i32 = 1000;
/// Smallest distance between the middles of two windows, mm.
const WINDOW_PITCH: i32 = 1500;
/// Sill and head of a window above the floor, mm.
const WINDOW_Z: Span = [900, 2400];

/// The use of a space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// A room for one or two people.
    Office,
    /// A room for about six people.
    Shared,
    Seminar,
    /// A laboratory or a lecture hall.
    Lab,
    Corridor,
    /// A stair well, open to the floors above and below.
    Stairs,
    /// The hall through all floors.
    Atrium,
}

impl Use {
    /// The use of a room, by its area (m²).
    pub fn of_room(area: f64) -> Use {
        match area {
            ..20.0 => Use::Office,
            ..36.0 => Use::Shared,
            ..60.0 => Use::Seminar,
            _ => Use::Lab,
        }
    }

    /// Whether it is open to the floors above and below.
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
    pub usage: Use,
    pub hollow: Cuboid,
    number: usize,
    /// Openings in its walls, each with its side.
    openings: Vec<(Facing, Opening)>,
    /// Linings of its doors: side, extent of the wall on that axis, opening.
    linings: Vec<(Facing, Span, Opening)>,
}

/// One storey.
pub struct Plan {
    /// Its number, counted from 0.
    pub level: usize,
    /// Whether it is the highest storey.
    pub uppermost: bool,
    /// Its spaces, by number.
    pub spaces: Vec<Space>,
}

impl Plan {
    /// A storey without spaces, of a building with a number of floors.
    pub fn new(level: usize, floors: usize) -> Plan {
        Plan { level, uppermost: level + 1 == floors, spaces: Vec::new() }
    }

    /// Elevation of the floor, mm.
    pub fn floor(&self) -> i32 {
        elevation(self.level)
    }

    /// Its height from floor to ceiling.
    pub fn clear(&self) -> Span {
        [self.floor(), self.floor() + CLEAR]
    }

    /// Adds a space and returns its index.
    pub fn add(&mut self, usage: Use, x: Span, y: Span) -> usize {
        let number = self.spaces.len() + 1;
        // Shafts extend to the floor above, rooms to their ceiling.
        let open_above = usage.is_shaft() && !self.uppermost;
        let height = if open_above { STOREY } else { CLEAR };
        let hollow = Cuboid { x, y, z: [self.floor(), self.floor() + height] };
        let space = Space { usage, hollow, number, openings: Vec::new(), linings: Vec::new() };
        self.spaces.push(space);
        self.spaces.len() - 1
    }

    /// Makes an opening in the wall on a side of space `a`, to space `b` behind it.
    pub fn join(&mut self, a: usize, side: Facing, b: usize, opening: Opening) {
        // Positions of the two surfaces of the wall.
        let near = self.spaces[a].hollow.outer(side).at;
        let far = self.spaces[b].hollow.outer(side.opposite()).at;
        self.spaces[a].openings.push((side, opening));
        self.spaces[b].openings.push((side.opposite(), opening));
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
        if level == 0 || !self.usage.is_shaft() {
            obj.rect(floor, self.hollow.inner(Up));
        }
        if self.hollow.z[1] == elevation(level) + CLEAR {
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

    /// A wall with its doors, or with windows if it is an outer wall.
    fn draw_side(&self, obj: &mut Obj, paint: &'static Material, side: Facing) {
        let inward = side.opposite();
        let wall = self.hollow.inner(inward);
        let own = self.openings.iter().filter(|opening| opening.0 == side);
        let mut openings: Vec<Opening> = own.map(|opening| opening.1).collect();
        if let Some(glass) = outer_face(side, wall.at) {
            openings = windows(wall.u, self.hollow.z[0]);
            let depth = [glass.min(wall.at), glass.max(wall.at)];
            for &window in &openings {
                obj.recess([&FRAME, &GLASS], Some(&FRAME), inward, depth, window);
            }
        }
        openings.sort_by_key(|opening| opening.along);
        obj.wall(paint, wall, &openings);
    }
}

/// Position of the glass in a wall, if it is an outer wall.
fn outer_face(side: Facing, at: i32) -> Option<i32> {
    let glass = match side {
        West | South => 0,
        East => SIZE[0],
        North => SIZE[1],
        Up | Down => return None,
    };
    ((at - glass).abs() == super::dimensions::WALL).then_some(glass)
}

/// As many windows as fit in a wall, evenly spaced.
fn windows([from, to]: Span, floor: i32) -> Vec<Opening> {
    let count = ((to - from) / WINDOW_PITCH).max(1);
    let middle = |i: i32| from + (to - from) * (2 * i + 1) / (2 * count);
    let z = WINDOW_Z.map(|z| floor + z);
    let window = |i: i32| Opening { along: [middle(i) - WINDOW / 2, middle(i) + WINDOW / 2], z };
    (0..count).map(window).collect()
}
