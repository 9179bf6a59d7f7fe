//! Changes to a scene that must not change its light.

use radiosity::glam::{DMat3, DVec3};
use radiosity::{Face, Scene, SceneError};
use schemars::JsonSchema;
use serde::Deserialize;

/// A change to a scene: rotation, then translation, then another order of its polygons.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Change {
    /// A rotation.
    pub turn: Option<Turn>,
    /// Translation along x, y and z, metres.
    pub shift: [f64; 3],
    /// Whether the polygons, and the corners of each, are reordered.
    pub reordered: bool,
}

/// A rotation about an axis through the origin.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// Angle in degrees, counter-clockwise.
    pub degrees: f64,
    /// The axis; any length but zero.
    pub about: [f64; 3],
}

impl Turn {
    /// The matrix; for multiples of 90° about an axis of coordinates exactly a signed permutation.
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
    /// If the result is not a valid scene, for example because it is too far from the origin.
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
        // The scene already has two polygons for each two-sided one.
        let mut materials = scene.materials.clone();
        materials.iter_mut().for_each(|material| material.two_sided = false);
        Ok(Scene::new(&faces, materials, scene.objects.clone())?.0)
    }

    /// The original position of a point of the changed scene, world coordinates.
    pub fn undone(&self, point: DVec3) -> DVec3 {
        self.matrix().transpose() * (point - DVec3::from(self.shift))
    }

    /// A description for the labels of runs.
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
