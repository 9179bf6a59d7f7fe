//! Stair wells: a landing to the south on every floor, one to the north half a storey higher, and
//! two ramps between them on either side of a wall.

use crate::obj::Obj;
use crate::palette::{CONCRETE, WALL};
use crate::shapes::{
    Cuboid,
    Facing::{Down, East, North, South, Up, West},
    Rect, Span,
};

use super::dimensions::{SLAB, STOREY, elevation};

/// Width of a flight, mm.
const FLIGHT: i32 = 1200;
/// Depth of the landings to the south and to the north, mm.
const LANDINGS: Span = [2200, 2000];
/// Height of a flight, mm.
const RISE: i32 = STOREY / 2;

/// Draws the stairs in a well of a given extent through a number of floors.
pub fn draw(obj: &mut Obj, x: Span, y: Span, floors: usize) {
    let run = [y[0] + LANDINGS[0], y[1] - LANDINGS[1]];
    let (west, east) = ([x[0], x[0] + FLIGHT], [x[1] - FLIGHT, x[1]]);
    let top = floors - 1;
    for level in 0..top {
        let end = if x[0] < 30_000 { "west" } else { "east" };
        obj.object(format_args!("stairs {}.{end}", level + 1));
        let floor = elevation(level);
        flight(obj, west, run, [floor, floor + RISE]);
        slab(obj, x, [run[1], y[1]], floor + RISE);
        flight(obj, east, run, [floor + 2 * RISE, floor + RISE]);
        slab(obj, x, [y[0], run[0]], floor + 2 * RISE);
    }
    // On the top floor no flight continues from the western half of the landing.
    let edge = elevation(top);
    let v = [edge - SLAB, edge];
    obj.rect(&CONCRETE, Rect { facing: North, at: run[0], u: west, v });
    obj.object("spine");
    let wall = Cuboid { x: [west[1], east[0]], y: run, z: [0, edge + 1000] };
    obj.faces(&WALL, wall, &[East, West, North, South, Up]);
}

/// Top and bottom of a landing. Flights hide its edges.
fn slab(obj: &mut Obj, x: Span, y: Span, z: i32) {
    obj.rect(&CONCRETE, Rect { facing: Up, at: z, u: x, v: y });
    obj.rect(&CONCRETE, Rect { facing: Down, at: z - SLAB, u: x, v: y });
}

/// Top and bottom of a ramp between two walls. Its height goes from `z[0]` to `z[1]` as y goes
/// along `run`. The bottom of the lowest flight starts where it leaves the ground.
fn flight(obj: &mut Obj, x: Span, run: Span, z: Span) {
    let ramp = |y: Span, z: Span| {
        [[x[0], y[0], z[0]], [x[1], y[0], z[0]], [x[1], y[1], z[1]], [x[0], y[1], z[1]]]
    };
    obj.polygon(&CONCRETE, &ramp(run, z));
    let mut below = (run, z.map(|z| z - SLAB));
    if below.1[0] < 0 {
        below = ([run[0] + SLAB * (run[1] - run[0]) / RISE, run[1]], [0, below.1[1]]);
    }
    let [a, b, c, d] = ramp(below.0, below.1);
    obj.polygon(&CONCRETE, &[b, a, d, c]);
}
