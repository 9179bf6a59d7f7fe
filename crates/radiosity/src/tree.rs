//! A tree of boxes over the polygons of an environment: which of them a bundle of rays can meet.
//!
//! It only saves the host time. What it leaves out no ray of the bundle hits; what the virtual
//! processor is charged for is the walk through the grid.

#![allow(clippy::needless_range_loop, reason = "plain loops become vector instructions")]

use multiversion::multiversion;

use crate::bounds::Bounds;
use crate::pyramid::Pyramid;

/// Children of a node.
const WIDE: usize = 8;

/// A bounding volume hierarchy of nodes with up to eight children, the root first.
#[derive(Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
}

/// The boxes of a node's children, coordinate by coordinate, so that all are tested at a time.
struct Node {
    low: [[f64; WIDE]; 3],
    high: [[f64; WIDE]; 3],
    children: [Child; WIDE],
}

/// Children to be visited, with the squares of their distances, the next one last.
#[derive(Default)]
pub(crate) struct Waiting(Vec<(f64, Child)>);

#[derive(Clone, Copy)]
enum Child {
    None,
    Node(u32),
    Item(u32),
}

impl Tree {
    /// A tree over boxes; item `i` is box `i`.
    pub(crate) fn new(boxes: &[Bounds]) -> Tree {
        let mut tree = Tree::default();
        if !boxes.is_empty() {
            let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
            tree.build(boxes, &mut items);
        }
        tree
    }

    /// A node over some items; its place.
    fn build(&mut self, boxes: &[Bounds], items: &mut [u32]) -> u32 {
        let place = self.nodes.len();
        // The box of no child is met by no pyramid.
        let (far, near) = ([[f64::INFINITY; WIDE]; 3], [[f64::NEG_INFINITY; WIDE]; 3]);
        self.nodes.push(Node { low: far, high: near, children: [Child::None; WIDE] });
        let mut groups = vec![items];
        while groups.len() < WIDE {
            // Halve the largest group.
            let largest = (0..groups.len())
                .fold(0, |a, b| if groups[b].len() > groups[a].len() { b } else { a });
            if groups[largest].len() == 1 {
                break;
            }
            let (low, high) = halve(boxes, groups.swap_remove(largest));
            groups.extend([low, high]);
        }
        for (i, group) in groups.into_iter().enumerate() {
            let around = around(boxes, group);
            for axis in 0..3 {
                self.nodes[place].low[axis][i] = around.min[axis];
                self.nodes[place].high[axis][i] = around.max[axis];
            }
            self.nodes[place].children[i] = match *group {
                [item] => Child::Item(item),
                _ => Child::Node(self.build(boxes, group)),
            };
        }
        place as u32
    }

    /// Visit the items whose boxes a pyramid meets within `limit` metres of its apex, nearer boxes
    /// first. A visit returns the limit from then on, or `None` to go no further; whether all were
    /// visited. `waiting` is room to work in, kept by the caller so that no visit asks for memory.
    pub(crate) fn visit(
        &self,
        pyramid: &Pyramid,
        mut limit: f64,
        Waiting(waiting): &mut Waiting,
        mut visit: impl FnMut(u32) -> Option<f64>,
    ) -> bool {
        if self.nodes.is_empty() {
            return true;
        }
        waiting.clear();
        waiting.push((0.0, Child::Node(0)));
        while let Some((square_distance, child)) = waiting.pop() {
            if square_distance > limit * limit {
                continue;
            }
            match child {
                Child::None => {}
                Child::Item(item) => match visit(item) {
                    Some(nearer) => limit = nearer,
                    None => return false,
                },
                Child::Node(node) => {
                    let node = &self.nodes[node as usize];
                    let met = meets(node, pyramid, limit);
                    let first = waiting.len();
                    for (&child, &distance) in node.children.iter().zip(&met) {
                        if distance < f64::INFINITY {
                            // Nearest last, to be taken first.
                            let after = |&(other, _): &(f64, Child)| other > distance;
                            let place = waiting[first..].partition_point(after);
                            waiting.insert(first + place, (distance, child));
                        }
                    }
                }
            }
        }
        true
    }
}

/// Halve items along the longest side of the box around them.
fn halve<'a>(boxes: &[Bounds], items: &'a mut [u32]) -> (&'a mut [u32], &'a mut [u32]) {
    let size = around(boxes, items).size();
    let axis = (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best });
    let middle = |i: u32| boxes[i as usize].min[axis] + boxes[i as usize].max[axis];
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
    items.split_at_mut(half)
}

fn around(boxes: &[Bounds], items: &[u32]) -> Bounds {
    Bounds::of(items.iter().flat_map(|&i| [boxes[i as usize].min, boxes[i as usize].max]))
}

/// The square of the distance of each child's box from the apex; infinite if it lies farther than
/// `limit` or outside the pyramid.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn meets(node: &Node, pyramid: &Pyramid, limit: f64) -> [f64; WIDE] {
    let mut square = [0.0; WIDE];
    let mut low = [[0.0; WIDE]; 3];
    let mut high = [[0.0; WIDE]; 3];
    for axis in 0..3 {
        let apex = pyramid.apex[axis];
        for i in 0..WIDE {
            low[axis][i] = node.low[axis][i] - apex;
            high[axis][i] = node.high[axis][i] - apex;
        }
        for i in 0..WIDE {
            let (l, h) = (low[axis][i], high[axis][i]);
            let outside = if l > 0.0 { l } else { 0.0 } + if h < 0.0 { h } else { 0.0 };
            square[i] += outside * outside;
        }
    }
    let mut inside = [u64::MAX; WIDE];
    for plane in pyramid.outwards {
        let mut least = [0.0; WIDE];
        for axis in 0..3 {
            // The corner farthest inside is the same for all boxes.
            let corner = if plane[axis] > 0.0 { &low[axis] } else { &high[axis] };
            for i in 0..WIDE {
                least[i] += plane[axis] * corner[i];
            }
        }
        for i in 0..WIDE {
            inside[i] &= u64::from(least[i] <= 0.0).wrapping_neg();
        }
    }
    for i in 0..WIDE {
        let near = u64::from(square[i] <= limit * limit).wrapping_neg() & inside[i];
        let far = f64::INFINITY.to_bits() & !near;
        square[i] = f64::from_bits((square[i].to_bits() & near) | far);
    }
    square
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// Every box that holds a point of a ray of the pyramid is visited, unless the limit is nearer.
    #[test]
    fn nothing_that_a_ray_meets_is_left_out() {
        let boxes: Vec<Bounds> = (0..500)
            .map(|i| {
                let at = DVec3::new(f64::from(i % 10), f64::from(i / 10 % 10), f64::from(i / 100));
                Bounds { min: at, max: at + 0.7 }
            })
            .collect();
        let tree = Tree::new(&boxes);
        let directions: Vec<DVec3> =
            (0..8).map(|i| DVec3::new(1.0, 0.5 + 0.02 * f64::from(i), 0.3).normalize()).collect();
        let frame = [DVec3::X, DVec3::Y, DVec3::Z];
        let apex = DVec3::new(0.35, 0.35, 0.35);
        let pyramid = Pyramid::around(&directions).over(apex, frame);
        for limit in [2.0, 5.0, 100.0] {
            let mut visited = vec![false; boxes.len()];
            tree.visit(&pyramid, limit, &mut Waiting::default(), |item| {
                visited[item as usize] = true;
                Some(limit)
            });
            assert!(visited.iter().filter(|&&v| v).count() < 100, "culls nothing");
            for direction in &directions {
                for step in 0..(limit.min(15.0) * 100.0) as u32 {
                    let point = apex + *direction * (f64::from(step) / 100.0);
                    let inside = |b: &Bounds| point.cmpge(b.min).all() && point.cmple(b.max).all();
                    for (i, _) in boxes.iter().enumerate().filter(|(_, b)| inside(b)) {
                        assert!(visited[i], "box {i} at {point}");
                    }
                }
            }
        }
    }
}
