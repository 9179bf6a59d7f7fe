//! Changes to a scene that must not change its light.

use radiosity::glam::{DMat3, DVec3};
use radiosity::{Face, Scene, SceneError};
use schemars::JsonSchema;
use serde::Deserialize;

/// A change to a scene: turned, then moved, its polygons in another order.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Change {
    /// Turned.
    pub turn: Option<Turn>,
    /// Moved so far along x, y and z, metres.
    pub shift: [f64; 3],
    /// Whether its polygons, and the corners of each, come in another order.
    pub reordered: bool,
}

/// A turn about an axis through the origin.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// By so much, counter-clockwise.
    pub degrees: f64,
    /// The axis; any length but none.
    pub about: [f64; 3],
}

impl Turn {
    /// Its matrix, exactly a permutation with signs where that is meant.
    fn matrix(self) -> DMat3 {
        let axis = DVec3::from(self.about).try_normalize().unwrap_or(DVec3::Z);
        let matrix = DMat3::from_axis_angle(axis, self.degrees.to_radians());
        let exact = |x: f64| if (x - x.round()).abs() < 1e-15 { x.round() } else { x };
        DMat3::from_cols_array(&matrix.to_cols_array().map(exact))
    }
}

impl Change {
    fn matrix(&self) -> DMat3 {
        self.turn.map_or(DMat3::IDENTITY, Turn::matrix)
    }

    /// The changed scene.
    ///
    /// # Errors
    /// If it is none any more, as when it is moved too far.
    pub fn of(&self, scene: &Scene) -> Result<Scene, SceneError> {
        let (matrix, shift) = (self.matrix(), DVec3::from(self.shift));
        let face = |polygon: &radiosity::Polygon| Face {
            points: scene.corners(polygon).map(|p| matrix * (p + scene.origin) + shift).collect(),
            material: polygon.material,
            object: polygon.object,
        };
        let mut faces: Vec<Face> = scene.polygons.iter().map(face).collect();
        if self.reordered {
            faces.reverse();
            faces.iter_mut().for_each(|face| face.points.rotate_left(2));
        }
        // A two-sided polygon stands there twice already.
        let mut materials = scene.materials.clone();
        materials.iter_mut().for_each(|material| material.two_sided = false);
        Ok(Scene::new(&faces, materials, scene.objects.clone())?.0)
    }

    /// Where a point of the changed scene, in world coordinates, was before.
    pub fn undone(&self, point: DVec3) -> DVec3 {
        self.matrix().transpose() * (point - DVec3::from(self.shift))
    }

    /// In words.
    pub fn label(&self) -> String {
        let mut parts = Vec::new();
        if let Some(Turn { degrees, about: [x, y, z] }) = self.turn {
            parts.push(format!("turned by {degrees}° about {x} {y} {z}"));
        }
        if self.shift != [0.0; 3] {
            let [x, y, z] = self.shift;
            parts.push(format!("moved by {x} {y} {z} m"));
        }
        if self.reordered {
            parts.push("reordered".to_owned());
        }
        parts.join(", ")
    }
}
