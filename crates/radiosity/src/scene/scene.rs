//! A scene: welded vertices, convex planar polygons, materials.

use glam::DVec3;

use crate::geometry::Bounds;
use crate::media::Medium;

/// Red, green, blue: a reflectance (0 to 1), a radiosity (W/m²) or a power (W), as the context says.
pub type Rgb = DVec3;

/// What a surface does with light.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the material file.
    pub name: String,
    /// Diffuse reflectance, each component in [0, 1) (`Kd`).
    pub reflectance: Rgb,
    /// Emitted radiosity in W/m², not negative (`Ke`).
    pub emission: Rgb,
    /// Whether both sides reflect and emit; otherwise the back absorbs what falls on it.
    pub two_sided: bool,
}

/// A plane `normal · p = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal, towards the front; exactly an axis where the polygon is axis-aligned, so that
    /// ray–plane and ray–grid arithmetic agree to the bit.
    pub normal: DVec3,
    /// Distance of the plane from the scene's origin along the normal, metres.
    pub offset: f64,
}

impl Plane {
    /// The same plane seen from behind, negated exactly.
    pub fn reversed(self) -> Plane {
        Plane { normal: -self.normal, offset: -self.offset }
    }
}

/// A convex planar polygon; its vertices run counter-clockwise seen from the front.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// Indices into [`Scene::vertices`], at least three.
    pub vertices: Vec<u32>,
    /// Index into [`Scene::materials`].
    pub material: u32,
    /// Index into [`Scene::objects`].
    pub object: u32,
    /// Supporting plane.
    pub plane: Plane,
    /// Area in m².
    pub area: f64,
}

/// A face as a file or a program states it, before cleaning.
#[derive(Clone, Debug)]
pub struct Face {
    /// Corners in world coordinates, metres, counter-clockwise seen from the front.
    pub points: Vec<DVec3>,
    /// Index into the materials.
    pub material: u32,
    /// Index into the objects.
    pub object: u32,
}

/// Surfaces and materials, ready to be meshed. Coordinates are metres, local to [`Scene::origin`].
#[derive(Clone, Debug)]
pub struct Scene {
    /// Welded vertices, local to `origin`.
    pub vertices: Vec<DVec3>,
    /// Clean polygons: convex, planar, of positive area, no two alike; a two-sided face stands here
    /// twice, back to back.
    pub polygons: Vec<Polygon>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Names of objects or groups.
    pub objects: Vec<String>,
    /// World position of the local origin: the centre of the bounds, so that f64 stays exact to
    /// nanometres wherever in the world a scene lies.
    pub origin: DVec3,
    /// Local bounds.
    pub bounds: Bounds,
    /// What absorbs light on its way.
    pub media: Vec<Medium>,
}

impl Scene {
    /// Corners of a polygon, in order, local coordinates.
    pub fn corners<'a>(&'a self, polygon: &'a Polygon) -> impl Iterator<Item = DVec3> + 'a {
        polygon.vertices.iter().map(|&v| self.vertices[v as usize])
    }

    /// Material of a polygon.
    pub fn material(&self, polygon: &Polygon) -> &Material {
        &self.materials[polygon.material as usize]
    }

    /// Sum of polygon areas, m².
    pub fn area(&self) -> f64 {
        self.polygons.iter().map(|p| p.area).sum()
    }

    /// Power that the scene emits, W per colour.
    pub fn emitted_power(&self) -> Rgb {
        self.polygons.iter().map(|p| self.material(p).emission * p.area).sum()
    }

    /// Length below which two positions count as one: 1e-9 of the scene's diagonal.
    pub fn tolerance(&self) -> f64 {
        1e-9 * (self.bounds.max - self.bounds.min).length()
    }
}
