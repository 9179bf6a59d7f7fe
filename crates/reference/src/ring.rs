//! Convex polygons as rings of corners, and their parts.

use radiosity::glam::DVec3;

/// Corners of a convex planar polygon, in order.
pub(crate) type Ring = Vec<DVec3>;

/// The parts of a convex polygon on either side of a plane: where `height`, which is linear, is not
/// negative, and the rest. A part that is less than a triangle is empty.
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

/// The part of a convex polygon where `height`, which is linear, is not negative.
pub(crate) fn above(ring: &[DVec3], height: impl Fn(DVec3) -> f64) -> Ring {
    let [above, _] = split(ring, height);
    above
}

/// What is left of `pieces` outside a convex region, where no height is negative; `height(i, point)`
/// is the height over its side `i`.
pub(crate) fn cut_out(
    pieces: Vec<Ring>,
    sides: usize,
    height: impl Fn(usize, DVec3) -> f64,
) -> Vec<Ring> {
    let beside =
        |piece: &Ring| (0..sides).any(|side| piece.iter().all(|&p| height(side, p) <= 0.0));
    if pieces.iter().all(beside) {
        return pieces;
    }
    let mut left = Vec::with_capacity(pieces.len() + sides);
    for piece in pieces {
        if beside(&piece) {
            left.push(piece);
            continue;
        }
        let mut inside = piece;
        for side in 0..sides {
            let [kept, outside] = split(&inside, |p| height(side, p));
            if !outside.is_empty() {
                left.push(outside);
            }
            inside = kept;
        }
    }
    left
}

/// The triangles of a fan over a ring.
pub(crate) fn fan(ring: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> + Clone + '_ {
    ring.windows(2).skip(1).map(|edge| [ring[0], edge[0], edge[1]])
}
