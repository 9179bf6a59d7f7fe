//! Writes rectangles, boxes and walls with openings as OBJ text.
//!
//! Whole millimetres make coincident corners exactly equal, and the text the same on every machine.

use std::collections::BTreeMap;
use std::fmt::{Display, Write};

use crate::palette::Material;
use crate::shapes::{
    Cuboid,
    Facing::{self, Down, East, North, South, Up, West},
    Opening, Point, Rect, Span, hollow,
};

/// An OBJ file under construction.
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
    /// Starts an object. All faces that follow belong to it.
    pub fn object(&mut self, name: impl Display) {
        put(&mut self.faces, format_args!("o {name}\n"));
        self.current = None;
    }

    /// Adds a planar convex polygon, with corners counter-clockwise seen from the front.
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

    /// Adds a rectangle.
    pub fn rect(&mut self, material: &'static Material, rect: Rect) {
        self.polygon(material, &rect.corners());
    }

    /// Adds the named outer faces of a box.
    pub fn faces(&mut self, material: &'static Material, cuboid: Cuboid, faces: &[Facing]) {
        for &facing in faces {
            self.rect(material, cuboid.outer(facing));
        }
    }

    /// Adds all outer faces of a box.
    pub fn solid(&mut self, material: &'static Material, cuboid: Cuboid) {
        self.faces(material, cuboid, &[East, West, North, South, Up, Down]);
    }

    /// Adds a vertical rectangle with openings inside it, in ascending order without overlap. It
    /// becomes full-height pieces between openings, and pieces below and above each one.
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

    /// Adds the lining of an opening through a wall: jambs, soffit and, if given, sill. The wall
    /// faces in the direction `facing` or in the opposite one. `depth` is its extent on that axis.
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

    /// Adds a recess in a wall that faces `facing`: lining, and a pane or leaf at its end.
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

    /// The text of both files. The first line of each is the comment `about`.
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

/// The text of the two files of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneText {
    /// Name of both files, without extension.
    pub name: String,
    /// The OBJ file. It refers to `<name>.mtl`.
    pub obj: String,
    /// The MTL file: reflectance in `Kd`, emitted radiosity in W/m² in `Ke`.
    pub mtl: String,
}

/// Formats millimetres as metres, exactly and without trailing zeros.
fn metres(mm: i32) -> String {
    let sign = if mm < 0 { "-" } else { "" };
    let digits = format!("{sign}{}.{:03}", mm.abs() / 1000, mm.abs() % 1000);
    digits.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Appends formatted text.
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
}
