//! Rectangles, boxes and walls with openings, written as OBJ text.
//!
//! Everything is in whole millimetres, so corners that should coincide do, and the text is the same
//! on every machine.

use std::collections::BTreeMap;
use std::fmt::{Display, Write};

use crate::SceneText;
use crate::palette::Material;

/// A point, mm.
pub type Point = [i32; 3];

/// From the lesser to the greater coordinate, mm.
pub type Span = [i32; 2];

/// The direction in which a rectangle faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// Towards greater x.
    East,
    /// Towards lesser x.
    West,
    /// Towards greater y.
    North,
    /// Towards lesser y.
    South,
    /// Towards greater z.
    Up,
    /// Towards lesser z.
    Down,
}

use Facing::{Down, East, North, South, Up, West};

/// An upright or level rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Rect {
    /// Where its front looks.
    pub facing: Facing,
    /// Its coordinate along the facing axis.
    pub at: i32,
    /// Its extent along the first remaining axis (x, or y if it faces east or west).
    pub u: Span,
    /// Its extent along the second remaining axis (z, or y if it is level).
    pub v: Span,
}

impl Rect {
    /// Corners, counter-clockwise seen from the front; the first edge runs along `u`.
    fn corners(&self) -> [Point; 4] {
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
    /// Extent in x.
    pub x: Span,
    /// Extent in y.
    pub y: Span,
    /// Extent in z.
    pub z: Span,
}

impl Cuboid {
    /// The face that looks outward in the given direction.
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

    /// The face that looks inward in the given direction: a wall, floor or ceiling of the hollow.
    pub fn inner(&self, facing: Facing) -> Rect {
        Rect { facing, ..self.outer(facing.opposite()) }
    }
}

impl Facing {
    /// The four sides of an upright body.
    pub const SIDES: [Facing; 4] = [East, West, North, South];

    /// The other way along the same axis.
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

/// An OBJ file in the making.
#[derive(Default)]
pub struct Obj {
    indices: BTreeMap<Point, usize>,
    vertices: String,
    faces: String,
    /// Materials in the order of their first use.
    materials: Vec<&'static Material>,
    current: Option<&'static str>,
}

impl Obj {
    /// What follows belongs to an object of this name.
    pub fn object(&mut self, name: impl Display) {
        put(&mut self.faces, format_args!("o {name}\n"));
        self.current = None;
    }

    /// A planar four-sided polygon, its corners counter-clockwise seen from the front.
    pub fn quad(&mut self, material: &'static Material, corners: [Point; 4]) {
        self.polygon(material, &corners);
    }

    /// A planar convex polygon, its corners counter-clockwise seen from the front.
    pub fn polygon(&mut self, material: &'static Material, corners: &[Point]) {
        if self.current != Some(material.name) {
            put(&mut self.faces, format_args!("usemtl {}\n", material.name));
            self.current = Some(material.name);
            if !self.materials.iter().any(|m| m.name == material.name) {
                self.materials.push(material);
            }
        }
        let vertices = corners.iter().map(|&corner| format!(" {}", self.vertex(corner)));
        let vertices: String = vertices.collect();
        put(&mut self.faces, format_args!("f{vertices}\n"));
    }

    /// A rectangle.
    pub fn rect(&mut self, material: &'static Material, rect: Rect) {
        self.quad(material, rect.corners());
    }

    /// Those faces of a box that are named, looking outward.
    pub fn faces(&mut self, material: &'static Material, cuboid: Cuboid, faces: &[Facing]) {
        for &facing in faces {
            self.rect(material, cuboid.outer(facing));
        }
    }

    /// A whole box.
    pub fn solid(&mut self, material: &'static Material, cuboid: Cuboid) {
        self.faces(material, cuboid, &[East, West, North, South, Up, Down]);
    }

    /// An upright rectangle less its openings, which must lie in it without overlap, in ascending
    /// order: full-height pieces between openings, and what is left below and above each.
    pub fn wall(&mut self, material: &'static Material, wall: Rect, openings: &[Opening]) {
        let [mut from, end] = wall.u;
        let [bottom, top] = wall.v;
        let mut piece = |u: Span, v: Span| {
            if u[0] < u[1] && v[0] < v[1] {
                self.rect(material, Rect { u, v, ..wall });
            }
        };
        for &Opening { along, z } in openings {
            piece([from, along[0]], wall.v);
            piece(along, [bottom, z[0]]);
            piece(along, [z[1], top]);
            from = along[1];
        }
        piece([from, end], wall.v);
    }

    /// What lines an opening through a wall: jambs, soffit and, where it is given, sill. The wall
    /// faces along `facing` or the opposite way; `depth` is its extent on that axis.
    pub fn reveal(
        &mut self,
        lining: &'static Material,
        sill: Option<&'static Material>,
        facing: Facing,
        depth: Span,
        opening: Opening,
    ) {
        let hollow = hollow(facing, depth, opening);
        let jambs = match facing {
            East | West => [North, South],
            North | South | Up | Down => [East, West],
        };
        if let Some(sill) = sill {
            self.rect(sill, hollow.inner(Up));
        }
        for side in [Down, jambs[0], jambs[1]] {
            self.rect(lining, hollow.inner(side));
        }
    }

    /// A recess in a wall that faces `facing`: its lining and, at its far end, a pane or a leaf.
    pub fn recess(
        &mut self,
        [lining, back]: [&'static Material; 2],
        sill: Option<&'static Material>,
        facing: Facing,
        depth: Span,
        opening: Opening,
    ) {
        self.reveal(lining, sill, facing, depth, opening);
        self.rect(back, hollow(facing, depth, opening).inner(facing));
    }

    /// The text of both files, each with `about` as its first line.
    pub fn into_text(self, name: &str, about: &str) -> SceneText {
        let head = format!("# {about}\n");
        let obj = format!(
            "{head}# metres, z up, fronts counter-clockwise\nmtllib {name}.mtl\n{}{}",
            self.vertices, self.faces
        );
        let mut mtl = format!("{head}# Kd: reflectance; Ke: emitted radiosity, W/m2\n");
        for material in &self.materials {
            put(&mut mtl, format_args!("\n{material}"));
        }
        SceneText { name: name.to_owned(), obj, mtl }
    }

    fn vertex(&mut self, point: Point) -> usize {
        let next = self.indices.len() + 1;
        *self.indices.entry(point).or_insert_with(|| {
            let [x, y, z] = point.map(metres);
            put(&mut self.vertices, format_args!("v {x} {y} {z}\n"));
            next
        })
    }
}

/// The box that an opening cuts out of a wall of that depth.
fn hollow(facing: Facing, depth: Span, Opening { along, z }: Opening) -> Cuboid {
    match facing {
        East | West => Cuboid { x: depth, y: along, z },
        North | South | Up | Down => Cuboid { x: along, y: depth, z },
    }
}

/// Millimetres printed as metres, exactly and no longer than need be.
fn metres(mm: i32) -> String {
    let sign = if mm < 0 { "-" } else { "" };
    let digits = format!("{sign}{}.{:03}", mm.abs() / 1000, mm.abs() % 1000);
    digits.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Appends to a text.
fn put(text: &mut String, words: std::fmt::Arguments<'_>) {
    text.write_fmt(words).expect("writing to a String does not fail");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metres_are_exact_and_short() {
        let printed = [0, 5, -30, 1200, -15_000, 16_800, 2057].map(metres);
        assert_eq!(printed, ["0", "0.005", "-0.03", "1.2", "-15", "16.8", "2.057"]);
    }

    #[test]
    fn fronts_face_where_they_say() {
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
