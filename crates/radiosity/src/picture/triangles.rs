//! A mesh of triangles with radiosity at the vertices, built from patches.

use std::collections::BTreeMap;

use glam::DVec3;

use super::stitch::Seams;
use crate::geometry::Bounds;
use crate::mesh::{LocalEnvironment, Space};
use crate::scene::{Polygon, Rgb, Scene};

/// How radiosity varies over a patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// A corner has the mean, weighted by area, of the patches of the same plane, object and
    /// material that meet there. The middle of a patch has the mean along its edges.
    #[default]
    Smooth,
    /// Constant radiosity on each patch.
    Flat,
}

/// A mesh of all patches of a scene. Each patch is a fan of triangles around its middle.
pub struct Mesh<'a> {
    environments: &'a [LocalEnvironment],
    /// The fan of each patch, by environment.
    fans: Vec<Vec<Fan>>,
    vertices: Vertices,
    /// The environments in which each polygon has patches, and their bounds.
    homes: Vec<Vec<(u32, Bounds)>>,
}

/// Vertices of a patch: its middle, then its corners. Empty for a patch without area.
type Fan = Vec<u32>;

impl<'a> Mesh<'a> {
    /// The mesh of all patches of these environments.
    pub fn new(space: &Space, environments: &'a [LocalEnvironment], shading: Shading) -> Mesh<'a> {
        let scene = &space.scene;
        let mut vertices = Vertices::new(STEP * scene.bounds.size().length(), shading);
        let mut homes = vec![Vec::new(); scene.polygons.len()];
        let mut fans: Vec<Vec<Fan>> = Vec::with_capacity(environments.len());
        for (number, environment) in (0..).zip(environments) {
            let bounds = space.grid.bounds(&environment.block).widened(scene.tolerance());
            let mut polygons: Vec<u32> = environment.patches.iter().map(|p| p.polygon).collect();
            polygons.dedup();
            polygons.iter().for_each(|&p| homes[p as usize].push((number, bounds)));
            let fan = |(patch, polygon)| {
                let outline = environment.outline(space, patch);
                vertices.fan(&scene.polygons[polygon as usize], &outline)
            };
            let polygons = environment.patches.iter().map(|patch| patch.polygon);
            fans.push((0..).zip(polygons).map(fan).collect());
        }
        vertices.stitch(&mut fans, environments, scene);
        Mesh { environments, fans, vertices, homes }
    }

    /// Positions of the vertices, local coordinates, metres.
    pub fn positions(&self) -> &[DVec3] {
        &self.vertices.positions
    }

    /// Unit normals of the vertices.
    pub fn normals(&self) -> &[DVec3] {
        &self.vertices.normals
    }

    /// Vertices of the triangles, counter-clockwise seen from the front. Triangles without area, with
    /// coordinates of 32 bits as in files, are left out.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let has_area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|v| self.positions()[v as usize].as_vec3().as_dvec3());
            (b - a).cross(c - a).length_squared() > 0.0
        };
        self.fans.iter().flatten().flat_map(|fan| triangles(fan)).filter(has_area)
    }

    /// Radiosity of the vertices from that of the patches, by environment and patch, W/m².
    pub fn light(&self, radiosity: &[Vec<Rgb>]) -> Vec<Rgb> {
        let mut sums = vec![(Rgb::ZERO, 0.0); self.vertices.positions.len()];
        let patches = self.environments.iter().flat_map(|e| &e.patches);
        let patches = patches.zip(radiosity.iter().flatten()).zip(self.fans.iter().flatten());
        for ((patch, &radiosity), fan) in patches {
            for &corner in fan.iter().skip(1) {
                let (sum, area) = &mut sums[corner as usize];
                *sum += radiosity * patch.area;
                *area += patch.area;
            }
        }
        let mean = |&(sum, area): &(Rgb, f64)| if area > 0.0 { sum / area } else { Rgb::ZERO };
        let mut light: Vec<Rgb> = sums.iter().map(mean).collect();
        for fan in self.fans.iter().flatten() {
            let Some((&middle, corners)) = fan.split_first() else { continue };
            let corner =
                |&vertex: &u32| (self.positions()[vertex as usize], light[vertex as usize]);
            light[middle as usize] = mean_along(corners.iter().map(corner));
        }
        light
    }

    /// The fan of each patch, environment after environment: its middle, then its corners.
    pub fn fans(&self) -> impl Iterator<Item = &[u32]> {
        self.fans.iter().flatten().map(Vec::as_slice)
    }

    /// Radiosity of a polygon at a point on its front, W/m², interpolated from `light` at the
    /// vertices. Zero where there is no patch.
    pub fn radiosity_at(&self, light: &[Rgb], polygon: u32, point: DVec3) -> Rgb {
        let homes = &self.homes[polygon as usize];
        let here = |bounds: &Bounds| point.clamp(bounds.min, bounds.max) == point;
        let home = homes.iter().find(|(_, bounds)| here(bounds)).or(homes.first());
        let Some(&(home, _)) = home else { return Rgb::ZERO };
        let patch = self.environments[home as usize].patch_at(polygon, point);
        let fan = patch.map(|patch| &self.fans[home as usize][patch as usize]);
        let triangles = fan.into_iter().flat_map(|fan| triangles(fan));
        let weighed = triangles.filter_map(|triangle| {
            let corners = triangle.map(|vertex| self.vertices.positions[vertex as usize]);
            Some((barycentric(corners, point)?, triangle))
        });
        // The triangle that contains the point or, after rounding, is nearest to it.
        let inside = weighed.max_by(|(a, _), (b, _)| a.min_element().total_cmp(&b.min_element()));
        let Some((weights, triangle)) = inside else { return Rgb::ZERO };
        let [a, b, c] = triangle.map(|vertex| light[vertex as usize]);
        a * weights.x + b * weights.y + c * weights.z
    }
}

/// The triangles of a fan: its middle and two consecutive corners.
fn triangles(fan: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let corners = fan.get(1..).unwrap_or_default();
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&corner, &next)| [fan[0], corner, next])
}

/// The mean along the edges between corners. Dividing an edge in two does not change it.
fn mean_along(corners: impl Iterator<Item = (DVec3, DVec3)> + Clone) -> DVec3 {
    let first = corners.clone().next();
    let next = corners.clone().cycle().skip(1);
    let (mut sum, mut length) = (DVec3::ZERO, 0.0);
    for ((from, a), (to, b)) in corners.zip(next) {
        let edge = from.distance(to);
        sum += (a + b) / 2.0 * edge;
        length += edge;
    }
    // Without an edge all corners are one point.
    if length > 0.0 { sum / length } else { first.map_or(DVec3::ZERO, |(_, a)| a) }
}

/// Barycentric coordinates of a point in the plane of a triangle, or `None` if it has no area.
fn barycentric([a, b, c]: [DVec3; 3], point: DVec3) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let part = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal);
    let whole = normal.length_squared();
    (whole > 0.0).then(|| DVec3::new(part(b, c), part(c, a), part(a, b)) / whole)
}

/// Grid step for merging vertices, as a fraction of the diagonal of the scene: positions that round
/// to the same step become one vertex.
const STEP: f64 = 1e-7;

/// Patches share vertices if they have the same object, the same material and the same plane normal
/// (in steps). At one point there is only one such plane.
type Group = (u32, u32, [i64; 3]);

/// The vertices of a mesh.
struct Vertices {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Length of a step, metres.
    step: f64,
    /// Vertices by group and position (in steps). Only for smooth shading.
    shared: Option<BTreeMap<(Group, [i64; 3]), u32>>,
}

impl Vertices {
    fn new(step: f64, shading: Shading) -> Vertices {
        let shared = (shading == Shading::Smooth).then(BTreeMap::new);
        Vertices { positions: Vec::new(), normals: Vec::new(), step, shared }
    }

    /// The fan of a patch with a convex outline on a polygon.
    fn fan(&mut self, polygon: &Polygon, outline: &[DVec3]) -> Fan {
        if outline.len() < 3 {
            return Fan::new();
        }
        let normal = polygon.plane.normal;
        let middle = mean_along(outline.iter().map(|&corner| (corner, corner)));
        let mut fan = vec![self.add(middle, normal)];
        for &corner in outline {
            let key = (group(polygon), steps(corner / self.step));
            let known = self.shared.as_ref().and_then(|shared| shared.get(&key)).copied();
            let vertex = known.unwrap_or_else(|| self.add(corner, normal));
            if let Some(shared) = &mut self.shared {
                shared.insert(key, vertex);
            }
            fan.push(vertex);
        }
        // Corners closer than a step are one vertex. Fewer than three are a patch that nobody can see.
        fan.dedup();
        if fan.len() > 2 && fan.last() == fan.get(1) {
            fan.pop();
        }
        if fan.len() > 3 { fan } else { Fan::new() }
    }

    /// Adds vertices that are on the edges of patches to the corners of these patches.
    fn stitch(&self, fans: &mut [Vec<Fan>], environments: &[LocalEnvironment], scene: &Scene) {
        let mut groups: BTreeMap<Group, Vec<u32>> = BTreeMap::new();
        for ((group, _), &vertex) in self.shared.iter().flatten() {
            groups.entry(*group).or_default().push(vertex);
        }
        let seams =
            |(group, vertices): (_, Vec<u32>)| (group, Seams::of(&vertices, &self.positions));
        let seams: BTreeMap<Group, Seams> = groups.into_iter().map(seams).collect();
        let patches = environments.iter().flat_map(|environment| &environment.patches);
        for (patch, fan) in patches.zip(fans.iter_mut().flatten()) {
            let group = group(&scene.polygons[patch.polygon as usize]);
            if let (Some(seams), Some(corners)) = (seams.get(&group), fan.get(1..)) {
                let corners = seams.stitch(corners, &self.positions, self.step);
                fan.truncate(1);
                fan.extend(corners);
            }
        }
    }

    fn add(&mut self, position: DVec3, normal: DVec3) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.positions.len() as u32 - 1
    }
}

/// The group of the patches of a polygon.
fn group(polygon: &Polygon) -> Group {
    (polygon.object, polygon.material, steps(polygon.plane.normal / STEP))
}

/// A vector rounded to integers.
fn steps(vector: DVec3) -> [i64; 3] {
    vector.to_array().map(|coordinate| coordinate.round() as i64)
}
