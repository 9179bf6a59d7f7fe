//! "A set of 32 similar rooms. Four tables, four doors open onto next rooms and one light source
//! compose a room. This is a symmetrical scene with many occlusions." (§5.1)
//!
//! Eight by four equal rooms. Each has half of the thickness of its walls and doors, so that no
//! surface is in the planes between rooms. An outer door has a closed leaf.

use crate::furniture::{around, column_table};
use crate::obj::Obj;
use crate::palette::{BLUE_WALL, CEILING, DOOR, FRAME, LIGHT, WARM_WALL, WOOD_FLOOR};
use crate::shapes::{
    Cuboid,
    Facing::{self, Down, East, North, South, Up, West},
    Opening, Rect,
};

/// Rooms along x and y.
const GRID: [i32; 2] = [8, 4];
/// Distance from the middle of a wall to the middle of the next, mm.
const PITCH: i32 = 5000;
/// Half the thickness of a wall, mm.
const HALF_WALL: i32 = 100;
/// Floor to ceiling, mm.
const HEIGHT: i32 = 3000;
/// Width and height of a door, mm.
const DOORWAY: [i32; 2] = [1000, 2100];
/// Number of tables in a room.
pub const TABLES: u32 = 4;
/// Largest number of tables in a room: seven by seven, still larger than their columns.
pub const MOST_TABLES: u32 = 49;
/// Size of the top of a table that is alone in a room, mm.
const TABLE: [i32; 2] = [2400, 1600];
/// Positions of the three tubes of a light along y, from the centre of the room, mm.
const TUBES: [i32; 3] = [-200, 0, 200];
/// Length and width of a tube, mm: four patches of 0.3 m.
const TUBE: [i32; 2] = [1200, 120];
/// How far the light hangs below the ceiling, mm.
const DROP: i32 = 30;

/// Draws the scene, with at most [`MOST_TABLES`] in each room.
pub fn draw(tables: u32) -> Obj {
    let mut obj = Obj::default();
    for row in 0..GRID[1] {
        for column in 0..GRID[0] {
            room(&mut obj, column, row, tables);
        }
    }
    obj
}

/// Draws a room, its tables and its light.
fn room(obj: &mut Obj, column: i32, row: i32, tables: u32) {
    let number = row * GRID[0] + column + 1;
    let cell = Cuboid {
        x: [column * PITCH, (column + 1) * PITCH],
        y: [row * PITCH, (row + 1) * PITCH],
        z: [0, HEIGHT],
    };
    obj.object(format_args!("room {number}"));
    shell(obj, cell, |side| match side {
        West => column == 0,
        East => column == GRID[0] - 1,
        South => row == 0,
        North => row == GRID[1] - 1,
        Up | Down => false,
    });
    let centre = [cell.x[0] + PITCH / 2, cell.y[0] + PITCH / 2];
    // Tables are placed on the smallest square that holds all of them, and scaled down accordingly.
    let side = (1..).find(|side| side * side >= tables as i32).unwrap_or(1);
    for i in 0..tables as i32 {
        obj.object(format_args!("table {number}.{}", i + 1));
        let along = |start: i32, step: i32| start + (2 * step + 1) * PITCH / (2 * side);
        let place = [along(cell.x[0], i % side), along(cell.y[0], i / side)];
        column_table(obj, place, TABLE.map(|size| size / side));
    }
    obj.object(format_args!("light {number}"));
    for y in TUBES {
        let (u, v) = (around(centre[0], TUBE[0]), around(centre[1] + y, TUBE[1]));
        obj.rect(&LIGHT, Rect { facing: Down, at: HEIGHT - DROP, u, v });
    }
}

/// Floor, ceiling, and walls with a door in the middle of each.
fn shell(obj: &mut Obj, cell: Cuboid, outer: impl Fn(Facing) -> bool) {
    let inside = |[a, b]: [i32; 2]| [a + HALF_WALL, b - HALF_WALL];
    let hollow = Cuboid { x: inside(cell.x), y: inside(cell.y), z: cell.z };
    obj.rect(&CEILING, hollow.inner(Down));
    // Under an outer wall the floor extends to the closed door leaf and replaces its sill, so that
    // all rooms have the same number of polygons.
    let mut floor = hollow;
    for side in Facing::SIDES.into_iter().filter(|&side| outer(side)) {
        match side {
            West => floor.x[0] = cell.x[0],
            East => floor.x[1] = cell.x[1],
            South => floor.y[0] = cell.y[0],
            _ => floor.y[1] = cell.y[1],
        }
    }
    obj.rect(&WOOD_FLOOR, floor.inner(Up));
    for side in Facing::SIDES {
        // The wall on the east side of a room faces west.
        let facing = side.opposite();
        let wall = hollow.inner(facing);
        let middle = (wall.u[0] + wall.u[1]) / 2;
        let door = Opening { along: around(middle, DOORWAY[0]), z: [0, DOORWAY[1]] };
        let paint = if matches!(side, East | West) { &WARM_WALL } else { &BLUE_WALL };
        obj.wall(paint, wall, &[door]);
        let edge = cell.inner(facing).at;
        let depth = [edge.min(wall.at), edge.max(wall.at)];
        if outer(side) {
            obj.recess([&FRAME, &DOOR], None, facing, depth, door);
        } else {
            obj.reveal(&FRAME, Some(&WOOD_FLOOR), facing, depth, door);
        }
    }
}
