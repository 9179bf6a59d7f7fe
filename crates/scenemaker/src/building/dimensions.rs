//! Dimensions of the building, and the bands and columns of its plan.

use crate::shapes::Span;

/// Outer extents in x and y, between the window panes, mm.
pub const SIZE: [i32; 2] = [60_000, 32_000];
/// Thickness of a wall, mm.
pub const WALL: i32 = 200;
/// Height of a storey from floor to floor, mm.
pub const STOREY: i32 = 3600;
/// Height from floor to ceiling, mm.
pub const CLEAR: i32 = 3000;
/// Thickness of landings and flights, mm.
pub const SLAB: i32 = 200;

/// Bands of the plan from south to north, mm. Between two bands is a wall.
pub mod band {
    use crate::shapes::Span;
    pub const SOUTH: Span = [200, 5300];
    pub const SOUTH_CORRIDOR: Span = [5500, 7900];
    pub const FRONT: Span = [8100, 12_200];
    pub const REAR: Span = [12_400, 15_900];
    pub const SPINE: Span = [16_100, 18_900];
    pub const BACK: Span = [19_100, 23_900];
    pub const NORTH_CORRIDOR: Span = [24_100, 26_500];
    pub const NORTH: Span = [26_700, 31_800];
    /// All inside the ring of corridors.
    pub const CORE: Span = [FRONT[0], BACK[1]];
    /// The front and the rear rows together.
    pub const DEEP: Span = [FRONT[0], REAR[1]];
}

/// Columns of the western half, mm. The eastern half mirrors them.
pub mod column {
    use crate::shapes::Span;
    pub const WEST: Span = [200, 5000];
    pub const CORRIDOR: Span = [5200, 7400];
    pub const CORE: Span = [7600, 24_400];
    pub const STAIRS: Span = [7600, 10_200];
    pub const BESIDE_STAIRS: Span = [10_400, 24_400];
}

/// Extent of the atrium in x, mm.
pub const ATRIUM: Span = [24_600, 35_400];

/// The span mirrored at the middle of the building.
pub fn mirrored([a, b]: Span) -> Span {
    [SIZE[0] - b, SIZE[0] - a]
}

/// Elevation of the floor of a storey, mm.
pub fn elevation(level: usize) -> i32 {
    // A level fits in 16 bits, so nothing is truncated.
    level as i32 * STOREY
}
