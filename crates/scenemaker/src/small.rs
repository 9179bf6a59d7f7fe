//! Small scenes for comparing methods: an empty room, a corridor with a corner, two rooms with a hole
//! between them, the Cornell box. All have few enough patches for a dense solution.

use crate::obj::Obj;
use crate::palette::{BOX_GREEN, BOX_LIGHT, BOX_RED, BOX_WHITE, CEILING, LIGHT, STONE, WALL};
use crate::shapes::{
    Cuboid,
    Facing::{self, Down, East, North, South, Up, West},
    Opening, Point, Rect, Span,
};

/// An empty room of 4 × 4 × 3 m with a light of 2 × 2 m in its ceiling. Its walls are divided at a
/// height of 2 m, so that halving gives 320 square patches of 0.5 m.
pub fn room4() -> Obj {
    let mut obj = Obj::default();
    obj.object("room");
    let hollow = Cuboid { x: [0, 4000], y: [0, 4000], z: [0, 3000] };
    obj.rect(&STONE, hollow.inner(Up));
    for z in [[0, 2000], [2000, 3000]] {
        let part = Cuboid { z, ..hollow };
        Facing::SIDES.into_iter().for_each(|side| obj.rect(&WALL, part.inner(side)));
    }
    ceiling_with_light(&mut obj, hollow.inner(Down), [1000, 3000], [1000, 3000]);
    obj
}

/// A corridor with two arms of 8 m, 2 m wide and 2.5 m high. The light is at the end of one arm, so
/// the other gets only reflected light.
pub fn corridor() -> Obj {
    let [long, wide, high] = [8000, 2000, 2500];
    let mut obj = Obj::default();
    obj.object("corridor");
    let east = Cuboid { x: [0, long], y: [0, wide], z: [0, high] };
    let north = Cuboid { x: [0, wide], y: [wide, long], z: [0, high] };
    obj.rect(&STONE, east.inner(Up));
    obj.rect(&STONE, north.inner(Up));
    obj.rect(&CEILING, north.inner(Down));
    obj.rect(&WALL, east.inner(North));
    obj.rect(&WALL, east.inner(West));
    obj.rect(&WALL, Rect { u: [wide, long], ..east.inner(South) });
    obj.rect(&WALL, north.inner(West));
    obj.rect(&WALL, north.inner(South));
    obj.rect(&WALL, Rect { u: [0, long], ..north.inner(East) });
    ceiling_with_light(&mut obj, east.inner(Down), [6000, 7000], [500, 1500]);
    obj
}

/// Two rooms of 4 × 4 × 3 m, one of them lit, joined by a hole of 0.5 m, one patch.
pub fn hole() -> Obj {
    let mut obj = Obj::default();
    let wall = [4000, 4200];
    let hole = Opening { along: [1500, 2000], z: [1000, 1500] };
    for (name, x) in [("lit room", [0, wall[0]]), ("dark room", [wall[1], 8200])] {
        let hollow = Cuboid { x, y: [0, 4000], z: [0, 3000] };
        obj.object(name);
        obj.rect(&STONE, hollow.inner(Up));
        obj.rect(&WALL, hollow.inner(North));
        obj.rect(&WALL, hollow.inner(South));
        let (pierced, whole) = if x[0] == 0 { (West, East) } else { (East, West) };
        obj.rect(&WALL, hollow.inner(whole));
        obj.wall(&WALL, hollow.inner(pierced), &[hole]);
        if x[0] == 0 {
            ceiling_with_light(&mut obj, hollow.inner(Down), [1000, 3000], [1000, 3000]);
        } else {
            obj.rect(&CEILING, hollow.inner(Down));
        }
    }
    obj.object("hole");
    obj.reveal(&WALL, Some(&WALL), East, wall, hole);
    obj
}

/// A ceiling with a light set into it.
fn ceiling_with_light(obj: &mut Obj, ceiling: Rect, u: Span, v: Span) {
    obj.wall(&CEILING, ceiling, &[Opening { along: u, z: v }]);
    obj.object("light");
    obj.rect(&LIGHT, Rect { u, v, ..ceiling });
}

/// Depth and height of the Cornell box, mm.
const DEPTH: i32 = 5592;
const HEIGHT: i32 = 5488;

/// The Cornell box, from the published coordinates of Cornell's Program of Computer Graphics
/// ("Cornell Box Data"), enlarged ten times to about 5.5 m. Its front is open, as in the original.
pub fn cornell() -> Obj {
    let mut obj = Obj::default();
    obj.object("floor");
    obj.polygon(&BOX_WHITE, &turned([[5528, 0, 0], [0, 0, 0], [0, 0, DEPTH], [5496, 0, DEPTH]]));
    obj.object("ceiling");
    let (x, y) = ([2130, 3430], [DEPTH - 3320, DEPTH - 2270]);
    let ceiling = Rect { facing: Down, at: HEIGHT, u: [0, 5560], v: [0, DEPTH] };
    obj.wall(&BOX_WHITE, ceiling, &[Opening { along: x, z: y }]);
    obj.object("light");
    obj.rect(&BOX_LIGHT, Rect { u: x, v: y, ..ceiling });
    obj.object("back wall");
    obj.polygon(
        &BOX_WHITE,
        &turned([[5496, 0, DEPTH], [0, 0, DEPTH], [0, HEIGHT, DEPTH], [5560, HEIGHT, DEPTH]]),
    );
    obj.object("right wall");
    obj.polygon(
        &BOX_GREEN,
        &turned([[0, 0, DEPTH], [0, 0, 0], [0, HEIGHT, 0], [0, HEIGHT, DEPTH]]),
    );
    obj.object("left wall");
    // Its corners are not in one plane, so it is two triangles.
    let left = turned([[5528, 0, 0], [5496, 0, DEPTH], [5560, HEIGHT, DEPTH], [5560, HEIGHT, 0]]);
    obj.polygon(&BOX_RED, &[left[0], left[1], left[2]]);
    obj.polygon(&BOX_RED, &[left[2], left[3], left[0]]);
    block(&mut obj, "short block", [[1300, 650], [820, 2250], [2400, 2720], [2900, 1140]], 1650);
    block(&mut obj, "tall block", [[4230, 2470], [2650, 2960], [3140, 4560], [4720, 4060]], 3300);
    obj
}

/// A block on the floor, given by the corners of its top in Cornell's x and z and by its height.
fn block(obj: &mut Obj, name: &str, top: [[i32; 2]; 4], height: i32) {
    obj.object(name);
    obj.polygon(&BOX_WHITE, &turned(top.map(|[x, z]| [x, height, z])));
    for i in 0..4 {
        let ([ax, az], [bx, bz]) = (top[i], top[(i + 1) % 4]);
        let side = [[ax, height, az], [ax, 0, az], [bx, 0, bz], [bx, height, bz]];
        obj.polygon(&BOX_WHITE, &turned(side));
    }
}

/// Converts corners from Cornell's axes (y up, z away from the viewer) to those used here.
fn turned(corners: [Point; 4]) -> [Point; 4] {
    corners.map(|[x, y, z]| [x, DEPTH - z, y])
}
