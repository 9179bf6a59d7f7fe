//! Splits boxes into groups for a bounding volume hierarchy, by the surface area heuristic.

use glam::DVec3;

use super::bounds::Bounds;

/// Bins along an axis. A group can be split between two of them.
const BINS: usize = 16;

/// Splits items, one box each, into at most `most` groups: the group with the largest surface is
/// halved until there are enough. `items` must not be empty, and no group is.
pub(crate) fn split<'a>(boxes: &[Bounds], items: &'a mut [u32], most: usize) -> Vec<&'a mut [u32]> {
    let mut groups = vec![(surface(&around(boxes, items)), items)];
    while groups.len() < most {
        let large = |i: &usize| groups[*i].1.len() > 1;
        let widest = (0..groups.len())
            .filter(large)
            .max_by(|&a, &b| groups[a].0.total_cmp(&groups[b].0).then(b.cmp(&a)));
        let Some(widest) = widest else { break };
        let (_, group) = groups.swap_remove(widest);
        let (low, high) = halve(boxes, group);
        groups.push((surface(&around(boxes, low)), low));
        groups.push((surface(&around(boxes, high)), high));
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Half the surface of a box. The probability that a ray meets the box is proportional to it.
fn surface(of: &Bounds) -> f64 {
    let DVec3 { x, y, z } = of.size();
    x * y + y * z + z * x
}

/// Splits items in two where the sum of surface × number of items of both parts is smallest (the
/// surface area heuristic, MacDonald and Booth 1990). Only the boundaries of evenly spaced bins are
/// tried. If none of them separates the items, the list is cut in the middle.
fn halve<'a>(boxes: &[Bounds], items: &'a mut [u32]) -> (&'a mut [u32], &'a mut [u32]) {
    let middle = |i: u32| boxes[i as usize].min + boxes[i as usize].max;
    let middles = Bounds::of(items.iter().map(|&i| middle(i)));
    let mut best = (f64::INFINITY, 0, 0);
    let bin = |i: u32, axis: usize| {
        let along = (middle(i)[axis] - middles.min[axis]) / middles.size()[axis];
        ((along * BINS as f64) as usize).min(BINS - 1)
    };
    for axis in (0..3).filter(|&axis| middles.size()[axis] > 0.0) {
        for (place, cost) in costs(boxes, items, |i| bin(i, axis)).into_iter().enumerate() {
            if cost < best.0 {
                best = (cost, axis, place);
            }
        }
    }
    let (cost, axis, place) = best;
    let half = if cost < f64::INFINITY {
        items.sort_unstable_by_key(|&i| (bin(i, axis) > place, i));
        items.partition_point(|&i| bin(i, axis) <= place)
    } else {
        items.len() / 2
    };
    items.split_at_mut(half)
}

/// Costs of splitting after each bin except the last. Infinite where a part would be empty.
fn costs(boxes: &[Bounds], items: &[u32], bin: impl Fn(u32) -> usize) -> [f64; BINS - 1] {
    let mut bins = [(0, Bounds::EMPTY); BINS];
    for &item in items {
        let (count, around) = &mut bins[bin(item)];
        *count += 1;
        *around = around.union(&boxes[item as usize]);
    }
    let add = |(count, around): &mut (usize, Bounds), bin: usize| {
        *count += bins[bin].0;
        *around = around.union(&bins[bin].1);
        if *count > 0 { *count as f64 * surface(around) } else { f64::INFINITY }
    };
    let mut costs = [0.0; BINS - 1];
    let (mut below, mut above) = ((0, Bounds::EMPTY), (0, Bounds::EMPTY));
    for place in 0..BINS - 1 {
        let mirrored = BINS - 2 - place;
        costs[place] += add(&mut below, place);
        costs[mirrored] += add(&mut above, mirrored + 1);
    }
    costs
}

/// The box around the boxes of some items.
pub(crate) fn around(boxes: &[Bounds], items: &[u32]) -> Bounds {
    items.iter().fold(Bounds::EMPTY, |around, &i| around.union(&boxes[i as usize]))
}
