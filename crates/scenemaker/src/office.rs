//! "An office with tables, chairs and shelves. The scene contains two lights on the ceiling. It's
//! an open scene with few occlusions." (§5.1)
//!
//! One long room: windows to the south, pairs of desks face to face along the middle, a meeting
//! table at the east end, bookcases along the north wall.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::furniture::{around, bookcase, chair, desk, leg_table};
use crate::obj::Obj;
use crate::palette::{
    BLUE, BLUE_WALL, CARPET, CEILING, DOOR, FRAME, GLASS, GREEN, LIGHT, RED, WALL, WARM_WALL, WOOD,
};
use crate::shapes::{
    Cuboid,
    Facing::{Down, East, North, South, Up, West},
    Opening, Rect, Span,
};
use crate::stream::stream;

/// Extents with the recesses of windows and door, mm.
const SIZE: [i32; 3] = [16_800, 6000, 3000];
/// Depth of a window, mm.
const WINDOW_DEPTH: i32 = 150;
/// Depth of the door's recess, mm.
const DOOR_DEPTH: i32 = 100;
/// Middle of each window along x, mm.
const WINDOWS: [i32; 4] = [2100, 6300, 10_500, 14_700];
/// Middle of each light along x, mm. Both are midway between south and north.
const LIGHTS: [i32; 2] = [4200, 12_600];
/// Size of a light, mm: eight patches of 0.6 m, aligned with the planes of 14 × 4 environments.
const PANEL: [i32; 2] = [2400, 1200];
/// How far a light hangs below the ceiling, mm.
const DROP: i32 = 40;
/// Middle of each pair of desks along x, mm.
const DESKS: [i32; 4] = [2000, 5200, 8400, 11_300];
/// Middle of the meeting table along x, mm.
const MEETING: i32 = 14_600;
/// Middle of each bookcase along x, mm.
const BOOKCASES: [i32; 3] = [2600, 5000, 11_300];
/// Middle of the door along x, mm.
const DOORWAY: i32 = 8100;

/// Extent of the whiteboard on the east wall, along y and z, mm.
const BOARD: [Span; 2] = [[1500, 4500], [900, 2100]];

/// Draws the scene.
pub fn draw(seed: u64) -> Obj {
    let mut obj = Obj::default();
    shell(&mut obj);
    lights(&mut obj);
    let mut chairs = Chairs { count: 0, rng: stream(seed, "chairs") };
    for (i, x) in DESKS.into_iter().enumerate() {
        desk_pair(&mut obj, i + 1, x, &mut chairs);
    }
    meeting(&mut obj, &mut chairs);
    let mut books = stream(seed, "books");
    for (i, x) in BOOKCASES.into_iter().enumerate() {
        obj.object(format_args!("shelf {}", i + 1));
        let wall = SIZE[1] - DOOR_DEPTH;
        let body = Cuboid { x: around(x, 1600), y: [wall - 340, wall], z: [0, 1800] };
        bookcase(&mut obj, body, &mut books);
    }
    obj
}

fn shell(obj: &mut Obj) {
    let room = Cuboid { x: [0, SIZE[0]], y: [WINDOW_DEPTH, SIZE[1] - DOOR_DEPTH], z: [0, SIZE[2]] };
    obj.object("room");
    obj.rect(&CARPET, room.inner(Up));
    obj.rect(&CEILING, room.inner(Down));
    obj.rect(&BLUE_WALL, room.inner(East));
    obj.rect(&WARM_WALL, room.inner(West));
    let windows = WINDOWS.map(|x| Opening { along: around(x, 2400), z: [900, 2400] });
    obj.wall(&WALL, room.inner(North), &windows);
    let door = Opening { along: around(DOORWAY, 1000), z: [0, 2100] };
    obj.wall(&WALL, room.inner(South), &[door]);

    for (i, window) in windows.into_iter().enumerate() {
        obj.object(format_args!("window {}", i + 1));
        obj.recess([&FRAME, &GLASS], Some(&WOOD), North, [0, room.y[0]], window);
    }
    obj.object("whiteboard");
    let board = Cuboid { x: [SIZE[0] - 30, SIZE[0]], y: BOARD[0], z: BOARD[1] };
    obj.faces(&CEILING, board, &[West, North, South, Up, Down]);
    obj.object("door");
    obj.recess([&FRAME, &DOOR], Some(&CARPET), South, [room.y[1], SIZE[1]], door);
}

fn lights(obj: &mut Obj) {
    for (i, x) in LIGHTS.into_iter().enumerate() {
        obj.object(format_args!("light {}", i + 1));
        let (u, v) = (around(x, PANEL[0]), around(SIZE[1] / 2, PANEL[1]));
        obj.rect(&LIGHT, Rect { facing: Down, at: SIZE[2] - DROP, u, v });
    }
}

/// Two desks face to face, each with a chair.
fn desk_pair(obj: &mut Obj, number: usize, x: i32, chairs: &mut Chairs) {
    let middle = SIZE[1] / 2;
    let sides: [(Span, i32, _); 2] = [
        ([middle - 820, middle - 20], middle - 1010, North),
        ([middle + 20, middle + 820], middle + 1010, South),
    ];
    for (i, (y, seat, looks)) in sides.into_iter().enumerate() {
        obj.object(format_args!("table {}", 2 * number + i - 1));
        desk(obj, around(x, 1600), y);
        chairs.draw(obj, &BLUE, [x, seat], looks);
    }
}

/// A long table with four chairs.
fn meeting(obj: &mut Obj, chairs: &mut Chairs) {
    let middle = SIZE[1] / 2;
    obj.object("table 9");
    leg_table(obj, around(MEETING, 2200), around(middle, 1100));
    for x in [MEETING - 550, MEETING + 550] {
        chairs.draw(obj, &RED, [x, middle - 700], North);
        chairs.draw(obj, &GREEN, [x, middle + 700], South);
    }
}

/// Chairs, each moved by a random distance.
struct Chairs {
    count: usize,
    rng: ChaCha8Rng,
}

impl Chairs {
    fn draw(
        &mut self,
        obj: &mut Obj,
        cloth: &'static crate::palette::Material,
        [x, y]: [i32; 2],
        looks: crate::shapes::Facing,
    ) {
        self.count += 1;
        obj.object(format_args!("chair {}", self.count));
        let aside = self.rng.random_range(-20..=20) * 10;
        let out = self.rng.random_range(0..=30) * 10;
        let place = match looks {
            East => [x - out, y + aside],
            West => [x + out, y + aside],
            North => [x + aside, y - out],
            _ => [x + aside, y + out],
        };
        chair(obj, cloth, place, looks);
    }
}
