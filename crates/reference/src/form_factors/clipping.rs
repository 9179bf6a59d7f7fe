//! Clipping of convex polygons by planes and by the shadows of other polygons.

use radiosity::glam::DVec3;

/// Corners of a convex planar polygon, in order.
pub(crate) type Ring = Vec<DVec3>;

/// The two parts of a convex polygon on either side of a plane. `height` is the signed distance to the plane,
/// or any other linear function; the first part is where it is not negative. A part with fewer than three
/// corners is empty.
pub(crate) fn split(ring: &[DVec3], height: impl Fn(DVec3) -> f64) -> [Ring; 2] {
    let mut parts = [Vec::with_capacity(ring.len() + 2), Vec::with_capacity(ring.len() + 2)];
    let Some(&last) = ring.last() else { return parts };
    let (mut before, mut height_before) = (last, height(last));
    for &here in ring {
        let height_here = height(here);
        if (height_before < 0.0) != (height_here < 0.0) {
            let share = height_before / (height_before - height_here);
            let crossing = before + (here - before) * share;
            parts.iter_mut().for_each(|part| part.push(crossing));
        }
        parts[usize::from(height_here < 0.0)].push(here);
        (before, height_before) = (here, height_here);
    }
    for part in parts.iter_mut().filter(|part| part.len() < 3) {
        part.clear();
    }
    parts
}

/// The part of a convex polygon where the linear function `height` is not negative.
pub(crate) fn above(ring: &[DVec3], height: impl Fn(DVec3) -> f64) -> Ring {
    let [above, _] = split(ring, height);
    above
}

/// The parts of `pieces` that a convex polygon does not hide from the origin. All coordinates are relative to
/// the origin; the pieces face it; `inwards` are the planes of the polygon's [`sides`], pointing inwards.
pub(crate) fn cut_out(pieces: Vec<Ring>, polygon: &[DVec3], inwards: &[DVec3]) -> Vec<Ring> {
    // Two convex polygons that do not overlap are separated by an edge of one of them.
    let separate = |piece: &Ring| {
        separates(inwards, polygon, piece) || separates(&sides(piece), piece, polygon)
    };
    if pieces.iter().all(separate) {
        return pieces;
    }
    let mut visible = Vec::with_capacity(pieces.len() + inwards.len());
    for piece in pieces {
        if separate(&piece) {
            visible.push(piece);
            continue;
        }
        let mut inside = piece;
        for side in inwards {
            let [kept, outside] = split(&inside, |p| side.dot(p));
            if !outside.is_empty() {
                visible.push(outside);
            }
            inside = kept;
        }
    }
    visible
}

/// Whether one of the planes has the ring `upper` on its upper side and the ring `lower` on its lower side.
/// Both sides are tested, since the plane of an edge of length 0 is arbitrary.
fn separates(planes: &[DVec3], upper: &[DVec3], lower: &[DVec3]) -> bool {
    planes.iter().any(|plane| {
        let slack = 1e-12 * plane.length();
        lower.iter().all(|p| plane.dot(*p) <= 0.0)
            && upper.iter().all(|p| plane.dot(*p) >= -slack * p.length())
            && slack > 0.0
    })
}

/// The ring without corners that are within `tolerance` of the corner before; empty if fewer than three are
/// left.
pub(crate) fn without_repeats(mut ring: Ring, tolerance: f64) -> Ring {
    ring.dedup_by(|next, before| next.distance(*before) <= tolerance);
    while ring.len() > 1 && ring[0].distance(ring[ring.len() - 1]) <= tolerance {
        ring.pop();
    }
    if ring.len() < 3 { Vec::new() } else { ring }
}

/// Normals of the planes through the origin and each edge of a ring. They point inwards if the ring faces the
/// origin.
pub(crate) fn sides(ring: &[DVec3]) -> Vec<DVec3> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&a, &b)| b.cross(a)).collect()
}

/// A ring in coordinates relative to a point.
pub(crate) fn seen_from(point: DVec3, ring: &[DVec3]) -> Ring {
    ring.iter().map(|&p| p - point).collect()
}

/// The triangles of a fan over a ring.
pub(crate) fn fan(ring: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> + Clone + '_ {
    ring.windows(2).skip(1).map(|edge| [ring[0], edge[0], edge[1]])
}
