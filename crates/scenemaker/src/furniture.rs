//! Tables, chairs and bookcases. Hidden contact faces are omitted, so that none coincide.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::obj::Obj;
use crate::palette::{BLUE, DARK_WOOD, GREEN, METAL, Material, RED, WOOD, YELLOW};
use crate::shapes::{
    Cuboid,
    Facing::{self, Down, East, North, South, Up, West},
    Span,
};

/// The interval of a given size around a centre.
pub fn around(centre: i32, size: i32) -> Span {
    [centre - size / 2, centre - size / 2 + size]
}

/// A table on one square column: ten polygons.
pub fn column_table(obj: &mut Obj, [x, y]: [i32; 2], [width, depth]: [i32; 2]) {
    let (x_span, y_span) = (around(x, width), around(y, depth));
    obj.solid(&WOOD, Cuboid { x: x_span, y: y_span, z: [700, 750] });
    let column = Cuboid { x: around(x, 200), y: around(y, 200), z: [0, 700] };
    obj.faces(&METAL, column, &Facing::SIDES);
}

/// A table on four legs: 22 polygons.
pub fn leg_table(obj: &mut Obj, x: Span, y: Span) {
    obj.solid(&WOOD, Cuboid { x, y, z: [710, 740] });
    legs(obj, x, y, 60, 710);
}

/// A desk between two panels: 14 polygons.
pub fn desk(obj: &mut Obj, x: Span, y: Span) {
    obj.solid(&WOOD, Cuboid { x, y, z: [710, 740] });
    for panel in [[x[0] + 20, x[0] + 50], [x[1] - 50, x[1] - 20]] {
        let panel = Cuboid { x: panel, y: [y[0] + 40, y[1] - 40], z: [0, 710] };
        obj.faces(&DARK_WOOD, panel, &Facing::SIDES);
    }
}

/// A chair that faces in the given direction: 27 polygons.
pub fn chair(obj: &mut Obj, cloth: &'static Material, [x, y]: [i32; 2], looks: Facing) {
    let seat = Cuboid { x: around(x, 440), y: around(y, 440), z: [430, 470] };
    obj.solid(cloth, seat);
    let thin = |span: Span| ([span[0], span[0] + 40], [span[1] - 40, span[1]]);
    let z = [470, 880];
    let back = match looks {
        East => Cuboid { x: thin(seat.x).0, z, ..seat },
        West => Cuboid { x: thin(seat.x).1, z, ..seat },
        North => Cuboid { y: thin(seat.y).0, z, ..seat },
        South | Up | Down => Cuboid { y: thin(seat.y).1, z, ..seat },
    };
    obj.faces(cloth, back, &[East, West, North, South, Up]);
    legs(obj, seat.x, seat.y, 40, 430);
}

/// Four square legs at the corners, slightly inside the edges.
fn legs(obj: &mut Obj, x: Span, y: Span, width: i32, height: i32) {
    let ends = |s: Span| [[s[0] + 10, s[0] + 10 + width], [s[1] - 10 - width, s[1] - 10]];
    for x in ends(x) {
        for y in ends(y) {
            obj.faces(&METAL, Cuboid { x, y, z: [0, height] }, &Facing::SIDES);
        }
    }
}

/// A bookcase against a wall to the north, with three inner boards and a block of books on each of
/// them and on the lowest board: 37 polygons.
pub fn bookcase(obj: &mut Obj, body: Cuboid, rng: &mut ChaCha8Rng) {
    const BOARD: i32 = 30;
    const LEVELS: i32 = 4;
    let Cuboid { x, z, .. } = body;
    let inside = [x[0] + BOARD, x[1] - BOARD];
    // The back board is between the interior and the wall, so that they are not in the same plane.
    let y = [body.y[0], body.y[1] - BOARD];
    let hollow = Cuboid { x: inside, y, z };
    obj.faces(&DARK_WOOD, body, &[East, West, Up]);
    obj.faces(&DARK_WOOD, Cuboid { x: [x[0], inside[0]], ..body }, &[South]);
    obj.faces(&DARK_WOOD, Cuboid { x: [inside[1], x[1]], ..body }, &[South]);
    for facing in [East, West, South] {
        obj.rect(&DARK_WOOD, hollow.inner(facing));
    }
    let pitch = (z[1] - BOARD - z[0]) / LEVELS;
    let front = [South, Up, Down];
    for level in 0..=LEVELS {
        let under = if level == LEVELS { z[1] - BOARD } else { z[0] + level * pitch };
        let board = Cuboid { x: inside, y, z: [under, under + BOARD] };
        // The lowest board is on the floor, and the body has the top of the highest one.
        let visible = match level {
            0 => &front[..2],
            LEVELS => &[South, Down],
            _ => &front,
        };
        obj.faces(&DARK_WOOD, board, visible);
        if level < LEVELS {
            books(obj, hollow, board.z[1], rng);
        }
    }
}

/// Books side by side, as one block.
fn books(obj: &mut Obj, hollow: Cuboid, floor: i32, rng: &mut ChaCha8Rng) {
    let cloth = [&RED, &BLUE, &GREEN, &YELLOW][rng.random_range(0..4)];
    let room = hollow.x[1] - hollow.x[0];
    let width = rng.random_range(room / 3..room * 4 / 5) / 10 * 10;
    let left = hollow.x[0] + rng.random_range(20..room - width - 20) / 10 * 10;
    let height = rng.random_range(22..32) * 10;
    let deep = [hollow.y[0] + 60, hollow.y[1]];
    let block = Cuboid { x: [left, left + width], y: deep, z: [floor, floor + height] };
    obj.faces(cloth, block, &[East, West, South, Up]);
}
