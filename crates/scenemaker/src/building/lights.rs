//! One thousand lights on five floors, each a panel in the grid of ceiling tiles.

use crate::obj::Obj;
use crate::palette::LIGHT;
use crate::shapes::{Cuboid, Facing::Down, Rect, Span};

use super::dimensions::{CLEAR, SIZE, SLAB};
use super::space::{Plan, Use};

/// Lights per floor: one thousand on five floors (§5.1).
const LIGHTS: usize = 200;
/// Edge of a ceiling tile, mm. The tiles start at the middle of the building and divide its length
/// and width into even parts, so that no panel crosses a plane that halves or quarters the plan.
const TILE: i32 = 600;
/// Edge of a panel inside its tile, mm.
const PANEL: i32 = 580;
/// How far a panel hangs below the ceiling, mm.
const DROP: i32 = 30;

/// Choice: how the lights are distributed. A space gets a number by its use. The remaining lights
/// are evenly spaced along all corridors. So floors with many offices have more lights.
fn lights_in(usage: Use) -> usize {
    match usage {
        Use::Office | Use::Shared => 2,
        Use::Seminar | Use::Lab => 3,
        Use::Stairs => 1,
        Use::Atrium => 9,
        Use::Corridor => 0,
    }
}

/// Draws all lights of the building.
pub fn draw(obj: &mut Obj, plans: &[Plan]) {
    let mut places = Vec::new();
    for space in plans.iter().flat_map(|plan| &plan.spaces) {
        if let Some(ceiling) = ceiling(space.usage, space.hollow) {
            let count = lights_in(space.usage) as i32;
            let length = longer(ceiling);
            let along = |i: i32| (length[1] - length[0]) * (2 * i + 1) / (2 * count);
            places.extend((0..count).map(|i| place(ceiling, along(i))));
        }
    }
    corridor_lights(&mut places, plans);
    for (i, [x, y, z]) in places.into_iter().enumerate() {
        obj.object(format_args!("light {}", i + 1));
        let span = |centre: i32| [centre - PANEL / 2, centre + PANEL / 2];
        obj.rect(&LIGHT, Rect { facing: Down, at: z - DROP, u: span(x), v: span(y) });
    }
}

/// Spaces the remaining lights evenly along all corridors.
fn corridor_lights(places: &mut Vec<[i32; 3]>, plans: &[Plan]) {
    let spaces = plans.iter().flat_map(|plan| &plan.spaces);
    let corridors: Vec<Cuboid> =
        spaces.filter(|s| s.usage == Use::Corridor).map(|s| s.hollow).collect();
    let length = |c: &Cuboid| i64::from(longer(*c)[1] - longer(*c)[0]);
    let total: i64 = corridors.iter().map(length).sum();
    let count = (LIGHTS * plans.len()).saturating_sub(places.len()) as i64;
    let (mut start, mut i) = (0, 0);
    for corridor in &corridors {
        while i < count && total * (2 * i + 1) / (2 * count) < start + length(corridor) {
            let along = total * (2 * i + 1) / (2 * count) - start;
            places.push(place(*corridor, along as i32));
            i += 1;
        }
        start += length(corridor);
    }
}

/// The part of a space with a ceiling for lights: the landings of a stair well, the uppermost
/// storey of the atrium, all of any other space.
fn ceiling(usage: Use, hollow: Cuboid) -> Option<Cuboid> {
    let Cuboid { y, z, .. } = hollow;
    // Only the uppermost storey of a shaft has a ceiling.
    let uppermost = z[1] - z[0] == CLEAR;
    match usage {
        Use::Atrium if !uppermost => None,
        Use::Stairs => {
            let top = if uppermost { z[1] } else { z[1] - SLAB };
            Some(Cuboid { y: [y[0], y[0] + 2200], z: [z[0], top], ..hollow })
        }
        _ => Some(hollow),
    }
}

/// The longer of the two horizontal extents.
fn longer(hollow: Cuboid) -> Span {
    let Cuboid { x, y, .. } = hollow;
    if x[1] - x[0] >= y[1] - y[0] { x } else { y }
}

/// The middle of the tile nearest to a position along the longer axis of a ceiling.
fn place(hollow: Cuboid, along: i32) -> [i32; 3] {
    let Cuboid { x, y, z } = hollow;
    let middle = |span: Span| (span[0] + span[1]) / 2;
    let at = longer(hollow)[0] + along;
    let (px, py) = if longer(hollow) == x { (at, middle(y)) } else { (middle(x), at) };
    [tile(px, SIZE[0] / 2, x), tile(py, SIZE[1] / 2, y), z[1]]
}

/// The middle of the tile nearest to `at` inside the span.
fn tile(at: i32, origin: i32, [from, to]: Span) -> i32 {
    let nearest = origin + (at - origin).div_euclid(TILE) * TILE + TILE / 2;
    if nearest - TILE / 2 < from {
        nearest + TILE
    } else if nearest + TILE / 2 > to {
        nearest - TILE
    } else {
        nearest
    }
}
