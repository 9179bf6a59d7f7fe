//! What a shot touches in memory, record by record: a cache wants to know more than counts.

use crate::environment::LocalEnvironment;
use crate::hemisphere::Hemisphere;
use crate::mask::Mask;
use crate::ray::Ray;
use crate::shot::Source;
use crate::space::Space;

/// A record that the virtual processor reads or writes while it casts rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Record {
    /// The direction of a pixel.
    Direction(u32),
    /// A cell of the grid, by its place, x running fastest, and its list of so many polygons.
    Cell {
        /// Its place.
        place: u32,
        /// Length of its list.
        polygons: u32,
    },
    /// The plane of a polygon.
    Plane(u32),
    /// The edges of a polygon whose plane the ray meets in this cell.
    Edges(u32),
    /// What finds the patch that a ray hits, and the patch.
    Hit {
        /// Its polygon.
        polygon: u32,
        /// Its number in its environment.
        patch: u32,
    },
}

/// Tell `touch` of every record, in the order in which [`shoot_plainly`](crate::shoot_plainly) comes by.
pub fn trace(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    source: &Source,
    mask: &Mask,
    mut touch: impl FnMut(Record),
) {
    let [tangent, bitangent, normal] = hemisphere.frame(source.centre, source.normal);
    let start = space.grid.cell_of(source.centre);
    for pixel in mask.ones() {
        touch(Record::Direction(pixel));
        let d = hemisphere.directions[pixel as usize];
        let ray = Ray::new(source.centre, tangent * d.x + bitangent * d.y + normal * d.z);
        let Some(mut passage) = space.grid.enter(&environment.block, &ray, start) else { continue };
        loop {
            let (place, listed) = (space.grid.index(passage.cell) as u32, passage.polygons());
            touch(Record::Cell { place, polygons: listed.len() as u32 });
            let others = listed.iter().copied().filter(|&polygon| polygon != source.polygon);
            if let Some((polygon, distance)) =
                nearest_hit(space, others, &ray, passage.exit(), &mut touch)
            {
                if let Some(patch) = environment.patch_at(polygon, ray.at(distance)) {
                    touch(Record::Hit { polygon, patch });
                }
                break;
            }
            if passage.step().is_err() {
                break;
            }
        }
    }
}

/// The nearest polygon of a cell that the ray hits before `exit`. Which of several coplanar ones it is
/// does not matter here.
fn nearest_hit(
    space: &Space,
    polygons: impl Iterator<Item = u32>,
    ray: &Ray,
    exit: f64,
    touch: &mut impl FnMut(Record),
) -> Option<(u32, f64)> {
    let mut nearest: Option<(u32, f64)> = None;
    for polygon in polygons {
        touch(Record::Plane(polygon));
        let limit = nearest.map_or(exit, |(_, distance)| distance);
        if space.facets.meets_plane(polygon, ray, limit).is_none() {
            continue;
        }
        touch(Record::Edges(polygon));
        if let Some(distance) = space.facets.hit(polygon, ray, limit) {
            nearest = Some((polygon, distance));
        }
    }
    nearest
}
