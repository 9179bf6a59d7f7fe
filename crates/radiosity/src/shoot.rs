//! Shooting a source through a local environment (§3.3, §4.2.3).

use glam::DVec3;

use crate::environment::LocalEnvironment;
use crate::facets::Ray;
use crate::grid::Side;
use crate::hemisphere::Hemisphere;
use crate::mask::Mask;
use crate::scene::Rgb;
use crate::space::Space;
use crate::work::{Operation, Work};

/// A patch that shoots, as every environment needs to know it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Source {
    /// Environment of the patch.
    pub environment: u32,
    /// The patch in that environment.
    pub patch: u32,
    /// Its polygon, which its own rays cannot hit.
    pub polygon: u32,
    /// Where its rays start.
    pub centre: DVec3,
    /// Unit normal, the hemisphere's axis.
    pub normal: DVec3,
    /// Unshot power that is being shot, W.
    pub power: Rgb,
    /// The same a unit of area, W/m²: the delta-radiosity of §4.2.2.
    pub radiosity: Rgb,
}

/// What became of a source's pixels in one environment. It depends on geometry alone, so a shot can
/// be kept and used again whatever power the source has.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Patches hit and the form factor that each got, by rising patch.
    pub hits: Vec<(u32, f64)>,
    /// Form factor of what fell on backs of polygons.
    pub backs: f64,
    /// Form factor of what left the scene.
    pub escaped: f64,
    /// For each side the pixels that leave through it, where there are any ([`Side::index`]).
    pub outgoing: [Option<Outgoing>; 6],
    /// Operations counted.
    pub work: Work,
}

/// A mask on its way to a neighbour.
#[derive(Clone, Debug, PartialEq)]
pub struct Outgoing {
    /// True for the pixels whose ray first leaves through this interface.
    ///
    /// Choice C12: §4.2.3 says "hits the plane". Taken of the unbounded plane, one pixel would reach
    /// several neighbours and its energy would double.
    pub mask: Mask,
    /// Their form factor together.
    pub form_factor: f64,
}

/// Where a ray's passage through an environment ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// On a polygon, at this distance.
    Hit {
        /// The polygon.
        polygon: u32,
        /// Metres from the ray's origin.
        distance: f64,
    },
    /// Through a side of the environment.
    Leaves(Side),
}

/// Cast the rays of all true pixels of `mask` from `source` through `environment`.
///
/// Paper: a ray that hits an object clears its pixel; each neighbour gets a copy of the mask with
/// the pixels whose rays enter it.
#[doc(alias = "compute_illumination")]
pub fn shoot(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Source,
    mask: &Mask,
) -> Shot {
    let [tangent, bitangent, normal] = hemisphere.frame(source.centre, source.normal);
    let mut form_factors = vec![0.0; environment.patches.len()];
    let mut shot = Shot {
        hits: Vec::new(),
        backs: 0.0,
        escaped: 0.0,
        outgoing: Default::default(),
        work: Work::NONE,
    };
    for pixel in mask.ones() {
        let d = hemisphere.directions[pixel as usize];
        let weight = hemisphere.weights[pixel as usize];
        let ray = Ray::new(source.centre, tangent * d.x + bitangent * d.y + normal * d.z);
        match cast(space, environment, &ray, source.polygon, &mut shot.work) {
            End::Hit { polygon, distance } => {
                let point = ray.origin + ray.direction * distance;
                let patch =
                    space.facets.faces(polygon, &ray).then(|| environment.patch_at(polygon, point));
                match patch.flatten() {
                    Some(patch) => form_factors[patch as usize] += weight,
                    None => shot.backs += weight,
                }
                shot.work.count(Operation::Hit, 1);
            }
            End::Leaves(side) if environment.has_neighbour(side) => {
                let outgoing = shot.outgoing[side.index()].get_or_insert_with(|| Outgoing {
                    mask: Mask::none(mask.pixels()),
                    form_factor: 0.0,
                });
                outgoing.mask.set(pixel);
                outgoing.form_factor += weight;
            }
            End::Leaves(_) => shot.escaped += weight,
        }
    }
    let patches = form_factors.into_iter().enumerate().map(|(patch, f)| (patch as u32, f));
    shot.hits = patches.filter(|&(_, form_factor)| form_factor > 0.0).collect();
    count_passes(&mut shot, environment, mask);
    shot
}

/// Follow one ray through an environment to the nearest hit or to the side by which it leaves.
pub fn cast(
    space: &Space,
    environment: &LocalEnvironment,
    ray: &Ray,
    own_polygon: u32,
    work: &mut Work,
) -> End {
    work.count(Operation::Ray, 1);
    let Some(mut passage) = space.grid.enter(&environment.block, ray) else {
        // Only a source in a side of its own environment has rays that never enter it. A ray that
        // starts in no other environment leaves the scene: through an outer side.
        let outwards = Side { axis: 0, upper: ray.direction.x > 0.0 };
        let side = space.grid.side_towards(&environment.block, ray.origin);
        return End::Leaves(side.unwrap_or(outwards));
    };
    loop {
        work.count(Operation::CellStep, 1);
        let polygons = passage.polygons();
        work.count(Operation::PolygonTest, polygons.len() as u64);
        if let Some((polygon, distance)) =
            nearest_hit(space, polygons, ray, own_polygon, passage.exit())
        {
            return End::Hit { polygon, distance };
        }
        if let Err(side) = passage.step() {
            return End::Leaves(side);
        }
    }
}

/// The nearest polygon of a cell that a ray hits before it leaves the cell. Of polygons at the same
/// distance a front goes before a back, then the lower number: coplanar surfaces have one owner.
#[inline]
fn nearest_hit(
    space: &Space,
    polygons: &[u32],
    ray: &Ray,
    own_polygon: u32,
    exit: f64,
) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for &polygon in polygons {
        if polygon == own_polygon {
            continue;
        }
        let limit = nearest.map_or(exit, |(_, distance)| distance);
        let Some(distance) = space.facets.hit(polygon, ray, limit) else { continue };
        let replaces = nearest.is_none_or(|(other, other_distance)| {
            distance < other_distance
                || (space.facets.faces(polygon, ray) && !space.facets.faces(other, ray))
        });
        if replaces {
            nearest = Some((polygon, distance));
        }
    }
    nearest
}

/// Count what §4.2.3 does apart from casting: every pixel of the mask is looked at, each neighbour
/// gets a copy of the mask, each pixel still true is tested against that neighbour's plane, and the
/// radiosities of all local patches are updated.
fn count_passes(shot: &mut Shot, environment: &LocalEnvironment, mask: &Mask) {
    let left: u64 = shot.outgoing.iter().flatten().map(|o| u64::from(o.mask.count())).sum();
    let neighbours = Side::ALL.iter().filter(|&&side| environment.has_neighbour(side)).count();
    let words = mask.words().len() as u64;
    shot.work.count(Operation::PixelTest, u64::from(mask.pixels()));
    shot.work.count(Operation::WordCopied, words * neighbours as u64);
    shot.work.count(Operation::PlaneTest, left * neighbours as u64);
    shot.work.count(Operation::PatchUpdate, environment.patches.len() as u64);
}
