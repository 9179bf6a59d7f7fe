//! Finds the pairs of boxes that meet.

use super::bounds::Bounds;
use super::split::{around, split};

/// Groups whose pairs are not more than this are compared one by one.
const FEW: usize = 64;

/// Calls `visit` once for each pair of boxes that meet, with the indices of both.
pub(crate) fn visit_pairs(boxes: &[Bounds], mut visit: impl FnMut(u32, u32)) {
    let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
    inside(boxes, &mut items, &mut visit);
}

/// The pairs of one group.
fn inside(boxes: &[Bounds], items: &mut [u32], visit: &mut impl FnMut(u32, u32)) {
    if items.len() * items.len() <= FEW {
        for (place, &one) in items.iter().enumerate() {
            for &other in &items[place + 1..] {
                if meet(&boxes[one as usize], &boxes[other as usize]) {
                    visit(one, other);
                }
            }
        }
        return;
    }
    let mut halves = split(boxes, items, 2).into_iter();
    let (Some(low), Some(high)) = (halves.next(), halves.next()) else { return };
    inside(boxes, low, visit);
    inside(boxes, high, visit);
    between(boxes, low, high, visit);
}

/// The pairs of a box of each group.
fn between(boxes: &[Bounds], one: &mut [u32], other: &mut [u32], visit: &mut impl FnMut(u32, u32)) {
    if !meet(&around(boxes, one), &around(boxes, other)) {
        return;
    }
    if one.len() * other.len() <= FEW {
        for &a in one.iter() {
            for &b in other.iter().filter(|&&b| meet(&boxes[a as usize], &boxes[b as usize])) {
                visit(a, b);
            }
        }
        return;
    }
    let (longer, shorter) = if one.len() > other.len() { (one, other) } else { (other, one) };
    for half in split(boxes, longer, 2) {
        between(boxes, half, shorter, visit);
    }
}

fn meet(one: &Bounds, other: &Bounds) -> bool {
    (one.min.cmple(other.max) & other.min.cmple(one.max)).all()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// The pairs are those that a comparison of all boxes with all finds.
    #[test]
    fn all_pairs_are_visited_once() {
        let boxes: Vec<Bounds> = (0..400)
            .map(|i: u32| {
                let at = DVec3::new(f64::from(i * 37 % 101), f64::from(i * 53 % 97), 0.0);
                Bounds { min: at, max: at + DVec3::new(f64::from(i % 13), 4.0, 0.0) }
            })
            .collect();
        let mut found = Vec::new();
        visit_pairs(&boxes, |a, b| found.push((a.min(b), a.max(b))));
        found.sort_unstable();
        let all = (0..400).flat_map(|a| (a + 1..400).map(move |b| (a, b)));
        let met = all.filter(|&(a, b)| meet(&boxes[a as usize], &boxes[b as usize]));
        assert_eq!(found, met.collect::<Vec<_>>());
    }
}
