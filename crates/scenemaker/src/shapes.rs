//! Shapes of scenes: rectangles, boxes and openings in walls, in whole millimetres.

use Facing::{Down, East, North, South, Up, West};

/// A point, mm.
pub type Point = [i32; 3];

/// An interval from the smaller to the larger coordinate, mm.
pub type Span = [i32; 2];

/// The direction of the front of a rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// Towards larger x.
    East,
    /// Towards smaller x.
    West,
    /// Towards larger y.
    North,
    /// Towards smaller y.
    South,
    /// Towards larger z.
    Up,
    /// Towards smaller z.
    Down,
}

/// A vertical or horizontal rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Rect {
    /// Direction of its front.
    pub facing: Facing,
    /// Its coordinate along the facing axis.
    pub at: i32,
    /// Its extent along the first remaining axis (x, or y if it faces east or west).
    pub u: Span,
    /// Its extent along the second remaining axis (z, or y if it is horizontal).
    pub v: Span,
}

impl Rect {
    /// Corners, counter-clockwise seen from the front. The first edge runs along `u`.
    pub fn corners(&self) -> [Point; 4] {
        let ([u0, u1], [v0, v1]) = (self.u, self.v);
        let plane = match self.facing {
            East | South | Up => [[u0, v0], [u1, v0], [u1, v1], [u0, v1]],
            West | North | Down => [[u1, v0], [u0, v0], [u0, v1], [u1, v1]],
        };
        plane.map(|[u, v]| match self.facing {
            East | West => [self.at, u, v],
            North | South => [u, self.at, v],
            Up | Down => [u, v, self.at],
        })
    }
}

/// A hole in a wall: a door, a window, an arch.
#[derive(Clone, Copy, Debug)]
pub struct Opening {
    /// Its extent along the wall.
    pub along: Span,
    /// Its extent in height.
    pub z: Span,
}

/// A box.
#[derive(Clone, Copy, Debug)]
pub struct Cuboid {
    pub x: Span,
    pub y: Span,
    pub z: Span,
}

impl Cuboid {
    /// The face with an outward normal in the given direction.
    pub fn outer(&self, facing: Facing) -> Rect {
        let Cuboid { x, y, z } = *self;
        match facing {
            East => Rect { facing, at: x[1], u: y, v: z },
            West => Rect { facing, at: x[0], u: y, v: z },
            North => Rect { facing, at: y[1], u: x, v: z },
            South => Rect { facing, at: y[0], u: x, v: z },
            Up => Rect { facing, at: z[1], u: x, v: y },
            Down => Rect { facing, at: z[0], u: x, v: y },
        }
    }

    /// The inside face with a normal in the given direction: a wall, floor or ceiling of a room.
    pub fn inner(&self, facing: Facing) -> Rect {
        Rect { facing, ..self.outer(facing.opposite()) }
    }
}

impl Facing {
    /// The four vertical sides.
    pub const SIDES: [Facing; 4] = [East, West, North, South];

    /// The opposite direction.
    pub fn opposite(self) -> Facing {
        match self {
            East => West,
            West => East,
            North => South,
            South => North,
            Up => Down,
            Down => Up,
        }
    }
}

/// The box that an opening cuts out of a wall.
pub fn hollow(facing: Facing, depth: Span, Opening { along, z }: Opening) -> Cuboid {
    match facing {
        East | West => Cuboid { x: depth, y: along, z },
        North | South | Up | Down => Cuboid { x: along, y: depth, z },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fronts_face_in_the_stated_direction() {
        for facing in [East, West, North, South, Up, Down] {
            let [a, b, c, _] = Rect { facing, at: 7, u: [1, 3], v: [2, 5] }.corners();
            let edge = |p: Point, q: Point| [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
            let ([ux, uy, uz], [vx, vy, vz]) = (edge(a, b), edge(b, c));
            let normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
            let expected = match facing {
                East => [6, 0, 0],
                West => [-6, 0, 0],
                North => [0, 6, 0],
                South => [0, -6, 0],
                Up => [0, 0, 6],
                Down => [0, 0, -6],
            };
            assert_eq!(normal, expected, "{facing:?}");
        }
    }
}
