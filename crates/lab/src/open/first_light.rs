//! Where the light of the lamps falls first: on fronts, on backs, or out of the scene.

use radiosity::glam::DVec3;
use radiosity::{
    End, Hemisphere, HemisphereKind, LocalEnvironment, PatchSize, Polygon, Ray, Rgb, Scene, Space,
    Work, cast,
};

use crate::files::counts::Counts;
use crate::open::cut::automatic_cells;

/// Points on the lamps of a scene, shared out by power.
const POINTS: usize = 64;

/// Rays from a point.
const RAYS: u32 = 64;

/// Shares of the power of the lamps, which sum to 1 if there is a lamp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FirstLight {
    /// Falls on fronts.
    pub fronts: f64,
    /// Falls on backs, which absorb it.
    pub backs: f64,
    /// Leaves the scene.
    pub leaves: f64,
    /// Metres from a lamp to what its light meets, on average.
    pub path: f64,
}

impl FirstLight {
    /// Casts rays from the lamps of a scene; none if it has no lamps.
    pub fn of(scene: &Scene) -> Option<FirstLight> {
        let lamps = lamps(scene, POINTS);
        if lamps.is_empty() {
            return None;
        }
        let rays = Rays::new(scene)?;
        let mut found = FirstLight::default();
        for (point, lamp) in lamps.into_iter().enumerate() {
            rays.cast_from(lamp, point, false, |end| found.count(&end));
        }
        let met = found.fronts + found.backs;
        let share = |count: f64| count / (met + found.leaves);
        Some(FirstLight {
            fronts: share(found.fronts),
            backs: share(found.backs),
            leaves: share(found.leaves),
            path: if met > 0.0 { found.path / met } else { 0.0 },
        })
    }

    fn count(&mut self, end: &RayEnd) {
        match *end {
            RayEnd::Meets { front, distance, .. } => {
                *(if front { &mut self.fronts } else { &mut self.backs }) += 1.0;
                self.path += distance;
            }
            RayEnd::Leaves => self.leaves += 1.0,
        }
    }
}

/// For each of `parts` equal parts of the power of the lamps, the lamp in whose light it begins; none without
/// light.
pub fn lamps(scene: &Scene, parts: usize) -> Vec<u32> {
    let powers: Vec<f64> = scene.polygons.iter().map(|polygon| power(scene, polygon)).collect();
    let all: f64 = powers.iter().sum();
    if !(all > 0.0 && all.is_finite()) {
        return Vec::new();
    }
    let (mut lamp, mut below) = (0, 0.0);
    let of_part = |part: usize| {
        let wanted = all * (part as f64 + 0.5) / parts as f64;
        while lamp + 1 < powers.len() && below + powers[lamp] <= wanted {
            below += powers[lamp];
            lamp += 1;
        }
        lamp as u32
    };
    (0..parts).map(of_part).collect()
}

fn power(scene: &Scene, polygon: &Polygon) -> f64 {
    scene.material(polygon).emission.element_sum() * polygon.area
}

/// Whether a polygon emits light.
pub fn emits(scene: &Scene, polygon: &Polygon) -> bool {
    scene.material(polygon).emission != Rgb::ZERO
}

/// Where a ray ends.
pub enum RayEnd {
    /// At a polygon.
    Meets {
        polygon: u32,
        /// Whether it is the front that it meets.
        front: bool,
        /// Metres.
        distance: f64,
    },
    /// Outside the scene.
    Leaves,
}

/// Rays through a scene, distributed as the light of a diffuse surface.
pub struct Rays {
    pub space: Space,
    whole: LocalEnvironment,
    hemisphere: Hemisphere,
}

impl Rays {
    pub fn new(scene: &Scene) -> Option<Rays> {
        let extents = scene.bounds.size();
        let cells = automatic_cells(extents.to_array(), scene.polygons.len(), Counts([1; 3]));
        let space = Space::new(scene.clone(), cells.0);
        // The mesh does not matter: a patch for each polygon.
        let size = PatchSize { reflector: extents.length(), emitter: extents.length() };
        let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, RAYS, true).ok()?;
        Some(Rays { space, whole, hemisphere })
    }

    /// Casts rays from a point of a polygon, from its back if it is `turned`; `number` says from which
    /// one: any numbers that follow one another share out the polygon evenly.
    pub fn cast_from(
        &self,
        polygon: u32,
        number: usize,
        turned: bool,
        mut end: impl FnMut(RayEnd),
    ) {
        let face = &self.space.scene.polygons[polygon as usize];
        let from = self.point(face, even(number));
        let normal = if turned { -face.plane.normal } else { face.plane.normal };
        let [u, v, w] = self.hemisphere.frame(from, normal);
        for way in &self.hemisphere.directions {
            end(self.cast(polygon, from, (u * way.x + v * way.y + w * way.z).normalize()));
        }
    }

    /// Casts a ray from a point of a polygon.
    pub fn cast(&self, polygon: u32, from: DVec3, way: DVec3) -> RayEnd {
        let (ray, mut work) = (Ray::new(from, way), Work::NONE);
        match cast(&self.space, &self.whole, &ray, polygon, &mut work) {
            End::Hit { polygon, distance } => {
                let front = self.space.facets.faces(polygon, &ray);
                RayEnd::Meets { polygon, front, distance }
            }
            End::Leaves(_) => RayEnd::Leaves,
        }
    }

    /// A point of a convex polygon, for two numbers from 0 to 1: equal areas are equally likely.
    pub fn point(&self, polygon: &Polygon, [a, b]: [f64; 2]) -> DVec3 {
        let corners: Vec<DVec3> = self.space.scene.corners(polygon).collect();
        let triangles = || corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]);
        let area = |[p, q, r]: [DVec3; 3]| (q - p).cross(r - p).length();
        let mut left = a * triangles().map(area).sum::<f64>();
        for [p, q, r] in triangles() {
            let size = area([p, q, r]);
            if left < size {
                let root = (left / size).sqrt();
                return p + (q - p) * (root * (1.0 - b)) + (r - p) * (root * b);
            }
            left -= size;
        }
        corners.iter().sum::<DVec3>() / corners.len() as f64
    }
}

/// Two numbers from 0 to 1; those of numbers that follow one another fill the square evenly (the additive
/// sequence of the plastic number).
fn even(number: usize) -> [f64; 2] {
    const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];
    STEPS.map(|step| (step * (number + 1) as f64).fract())
}
