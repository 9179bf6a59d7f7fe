//! A scene: welded vertices, convex planar polygons, materials, media.

use glam::DVec3;

use crate::geometry::Bounds;
use crate::media::Medium;

/// Red, green, blue: a reflectance (0 to 1), a radiosity (W/m²) or a power (W).
pub type Rgb = DVec3;

/// How a surface reflects and emits light.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name in the material file.
    pub name: String,
    /// Diffuse reflectance, each component in [0, 1] (`Kd`).
    pub reflectance: Rgb,
    /// Emitted radiosity in W/m², not negative (`Ke`).
    pub emission: Rgb,
    /// Whether both sides reflect and emit. Otherwise the back absorbs all light.
    pub two_sided: bool,
}

/// Reflectance of materials and faces that have none.
pub const DEFAULT_REFLECTANCE: Rgb = Rgb::splat(0.5);

impl Default for Material {
    /// The material of faces without one: grey, not emitting, one-sided.
    fn default() -> Material {
        Material {
            name: "default".to_owned(),
            reflectance: DEFAULT_REFLECTANCE,
            emission: Rgb::ZERO,
            two_sided: false,
        }
    }
}

/// A plane `normal · p = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal of the front. Exactly an axis for an axis-aligned polygon, so that ray–plane and
    /// ray–grid arithmetic agree to the bit.
    pub normal: DVec3,
    /// Distance of the plane from the scene's origin along the normal, metres.
    pub offset: f64,
}

impl Plane {
    /// The same plane facing the other way, negated exactly.
    pub fn reversed(self) -> Plane {
        Plane { normal: -self.normal, offset: -self.offset }
    }
}

/// A convex planar polygon. Its vertices run counter-clockwise seen from the front.
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

/// A face before cleaning, as read from a file.
#[derive(Clone, Debug)]
pub struct Face {
    /// Corners in world coordinates, metres, counter-clockwise seen from the front.
    pub points: Vec<DVec3>,
    /// Index into the materials.
    pub material: u32,
    /// Index into the objects.
    pub object: u32,
}

/// Clean surfaces and their materials. Coordinates are in metres, local to [`Scene::origin`].
#[derive(Clone, Debug)]
pub struct Scene {
    /// Welded vertices, local to `origin`.
    pub vertices: Vec<DVec3>,
    /// Clean polygons: convex, planar, of positive area. Two-sided faces are two polygons.
    pub polygons: Vec<Polygon>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Names of objects and groups.
    pub objects: Vec<String>,
    /// World position of the local origin: the centre of the bounds. Local coordinates stay exact
    /// to nanometres even if the scene is far from the origin of the world.
    pub origin: DVec3,
    /// Local bounds.
    pub bounds: Bounds,
    /// Upward direction, a unit vector, for pictures.
    pub up: DVec3,
    /// Participating media.
    pub media: Vec<Medium>,
}

impl Scene {
    /// Corners of a polygon in order, local coordinates.
    pub fn corners<'a>(&'a self, polygon: &'a Polygon) -> impl Iterator<Item = DVec3> + 'a {
        polygon.vertices.iter().map(|&v| self.vertices[v as usize])
    }

    /// Material of a polygon.
    pub fn material(&self, polygon: &Polygon) -> &Material {
        &self.materials[polygon.material as usize]
    }

    /// Material of a polygon, given by its index.
    pub fn material_of(&self, polygon: u32) -> &Material {
        self.material(&self.polygons[polygon as usize])
    }

    /// Total area of the polygons, m².
    pub fn area(&self) -> f64 {
        self.polygons.iter().map(|p| p.area).sum()
    }

    /// Emitted power, W.
    pub fn emitted_power(&self) -> Rgb {
        self.polygons.iter().map(|p| self.material(p).emission * p.area).sum()
    }

    /// Whether a polygon emits light and one reflects light.
    pub fn may_reflect_light(&self) -> bool {
        let any = |colour: fn(&Material) -> Rgb| {
            self.polygons.iter().any(|polygon| colour(self.material(polygon)) != Rgb::ZERO)
        };
        any(|material| material.emission) && any(|material| material.reflectance)
    }

    /// Positions closer than this count as equal: 1e-9 of the diagonal of the scene, metres.
    pub fn tolerance(&self) -> f64 {
        1e-9 * self.bounds.size().length()
    }
}
