//! The layout of a storey: corridors, shafts, and rows of rooms.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::dimensions::{ATRIUM, SIZE, WALL, band, column, mirrored};
use super::space::{Plan, Use};
use crate::shapes::{
    Facing::{self, East, North, South, West},
    Opening, Span,
};

/// Numbers of rooms in the rows of a storey.
struct Storey {
    south: usize,
    north: usize,
    /// At the west end, and the same number at the east end.
    ends: usize,
    /// Between south corridor and spine, on either side of the atrium.
    inner: Inner,
    /// Between spine and north corridor, on either side of the atrium.
    back: usize,
}

enum Inner {
    /// A number of rooms from the corridor to the spine.
    Deep(usize),
    /// A front and a rear row, with a number of rooms each.
    Rows(usize),
}

/// The five floors, from the lowest.
const STOREYS: [Storey; 5] = [
    Storey { south: 5, north: 6, ends: 2, inner: Inner::Deep(1), back: 1 },
    Storey { south: 8, north: 9, ends: 3, inner: Inner::Deep(2), back: 2 },
    Storey { south: 13, north: 14, ends: 4, inner: Inner::Rows(3), back: 3 },
    Storey { south: 17, north: 18, ends: 5, inner: Inner::Rows(4), back: 5 },
    Storey { south: 18, north: 18, ends: 5, inner: Inner::Rows(4), back: 5 },
];

/// Number of floors of the building of the paper.
pub const FLOORS: u16 = STOREYS.len() as u16;

/// Lays out one storey.
pub fn lay_out(plan: Plan, rng: &mut ChaCha8Rng) -> Plan {
    let storey = &STOREYS[plan.level % STOREYS.len()];
    let mut layout = Layout::with_corridors(plan, rng);
    layout.shafts();
    let [south, north] = [layout.south, layout.north];
    let length = [WALL, SIZE[0] - WALL];
    layout.row(storey.south, length, band::SOUTH, &[(North, south)]);
    layout.row(storey.north, length, band::NORTH, &[(South, north)]);
    for (half, inward) in [East, West].into_iter().enumerate() {
        layout.half(storey, half, inward);
    }
    layout.plan
}

/// A storey under construction: its plan so far, and the indices of its corridors.
struct Layout<'a> {
    plan: Plan,
    rng: &'a mut ChaCha8Rng,
    south: usize,
    north: usize,
    /// West and east corridor.
    cross: [usize; 2],
    /// West and east part of the spine.
    spine: [usize; 2],
}

impl<'a> Layout<'a> {
    /// A ring of corridors and the spine, which the atrium interrupts.
    fn with_corridors(mut plan: Plan, rng: &'a mut ChaCha8Rng) -> Layout<'a> {
        let length = [WALL, SIZE[0] - WALL];
        let south = plan.add(Use::Corridor, length, band::SOUTH_CORRIDOR);
        let north = plan.add(Use::Corridor, length, band::NORTH_CORRIDOR);
        let between = [band::SOUTH_CORRIDOR[1], band::NORTH_CORRIDOR[0]];
        let cross = [column::CORRIDOR, mirrored(column::CORRIDOR)]
            .map(|x| plan.add(Use::Corridor, x, between));
        let spine = [column::CORRIDOR[1], ATRIUM[0] - WALL];
        let spine = [spine, mirrored(spine)].map(|x| plan.add(Use::Corridor, x, band::SPINE));
        let z = plan.clear();
        for (i, side) in [(0, East), (1, West)] {
            let along = plan.spaces[cross[i]].hollow.x;
            plan.join(south, North, cross[i], Opening { along, z });
            plan.join(north, South, cross[i], Opening { along, z });
            plan.join(cross[i], side, spine[i], Opening { along: band::SPINE, z });
        }
        Layout { plan, rng, south, north, cross, spine }
    }

    /// Stair wells, and the atrium with arches to it. Above the lowest floor they have parapets.
    fn shafts(&mut self) {
        let floor = self.plan.floor();
        for x in [column::STAIRS, mirrored(column::STAIRS)] {
            let well = self.plan.add(Use::Stairs, x, band::DEEP);
            let middle = (x[0] + x[1]) / 2;
            let along = [middle - 450, middle + 450];
            self.plan.join(well, South, self.south, Opening { along, z: [floor, floor + 2100] });
        }
        let atrium = self.plan.add(Use::Atrium, ATRIUM, band::CORE);
        let sill = if self.plan.level == 0 { 0 } else { 1000 };
        let z = [floor + sill, floor + 2500];
        for bay in 0..3 {
            let from = ATRIUM[0] + 600 + bay * 3400;
            let arch = Opening { along: [from, from + 2800], z };
            self.plan.join(atrium, South, self.south, arch);
            self.plan.join(atrium, North, self.north, arch);
        }
        let along = [band::SPINE[0] + 300, band::SPINE[1] - 300];
        self.plan.join(atrium, West, self.spine[0], Opening { along, z });
        self.plan.join(atrium, East, self.spine[1], Opening { along, z });
    }

    /// The rooms at one end and in the core on one side of the atrium: west (0) or east (1).
    fn half(&mut self, storey: &Storey, half: usize, inward: Facing) {
        let side = |x: Span| if half == 0 { x } else { mirrored(x) };
        let [south, north] = [self.south, self.north];
        let spine = self.spine[half];
        self.end_row(storey.ends, side(column::WEST), band::CORE, (inward, self.cross[half]));
        let beside = side(column::BESIDE_STAIRS);
        match storey.inner {
            Inner::Deep(count) => {
                self.row(count, beside, band::DEEP, &[(South, south), (North, spine)]);
            }
            Inner::Rows(count) => {
                self.row(count, beside, band::FRONT, &[(South, south)]);
                self.row(count, beside, band::REAR, &[(North, spine)]);
            }
        }
        self.row(storey.back, side(column::CORE), band::BACK, &[(North, north)]);
    }

    /// Rooms side by side from west to east, each with doors to the given corridors.
    fn row(&mut self, count: usize, x: Span, y: Span, doors: &[(Facing, usize)]) {
        for x in partition(self.rng, x, count) {
            self.room(x, y, doors);
        }
    }

    /// Rooms side by side from south to north.
    fn end_row(&mut self, count: usize, x: Span, y: Span, door: (Facing, usize)) {
        for y in partition(self.rng, y, count) {
            self.room(x, y, &[door]);
        }
    }

    /// A room with doors to corridors.
    fn room(&mut self, x: Span, y: Span, doors: &[(Facing, usize)]) {
        let area = f64::from(x[1] - x[0]) * f64::from(y[1] - y[0]) * 1e-6;
        let room = self.plan.add(Use::of_room(area), x, y);
        for &(side, corridor) in doors {
            let along = if matches!(side, East | West) { y } else { x };
            let width = if area < 45.0 { 900 } else { 1800 };
            // A door is near one end of its wall.
            let from =
                if self.rng.random_bool(0.5) { along[0] + 300 } else { along[1] - 300 - width };
            let z = [self.plan.floor(), self.plan.floor() + 2100];
            self.plan.join(room, side, corridor, Opening { along: [from, from + width], z });
        }
    }
}

/// Divides a length into rooms of unequal width with walls between them. The widest takes at most
/// 1.8 times as much as the narrowest.
fn partition(rng: &mut ChaCha8Rng, [from, to]: Span, count: usize) -> Vec<Span> {
    let weights: Vec<i32> = (0..count).map(|_| rng.random_range(10..=18)).collect();
    let sum: i32 = weights.iter().sum();
    let pitch = to + WALL - from;
    let mut taken = 0;
    let edge = |taken: i32| from + pitch * taken / sum / 10 * 10;
    let span = |weight: &i32| {
        let west = edge(taken);
        taken += weight;
        [west, edge(taken) - WALL]
    };
    weights.iter().map(span).collect()
}
