//! A bounding volume hierarchy: finds the boxes that a bundle of rays can meet.
//!
//! It only saves time of the host: no ray of the bundle can hit what is left out. The simulated
//! processor is charged for the walk through the grid. Single precision, with a margin, is enough.

use fearless_simd::f32x16;
use fearless_simd::prelude::*;

use super::bounds::Bounds;
use super::pyramid::Pyramid;
use super::split::{around, split};

/// Maximum number of children of a node.
const CHILDREN: usize = 16;

/// A bounding volume hierarchy of nodes with up to sixteen children. The root is the first node.
#[derive(Default)]
pub(crate) struct BoxTree {
    nodes: Vec<Node>,
    /// The largest absolute coordinate of all boxes.
    reach: f64,
}

/// One number for each child of a node.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct PerChild([f32; CHILDREN]);

/// The boxes of the children, stored by coordinate so that all of them are tested at once.
struct Node {
    low: [PerChild; 3],
    high: [PerChild; 3],
    /// Index of a node, or of an item with the bit [`ITEM`] set.
    children: [u32; CHILDREN],
}

const ITEM: u32 = 1 << 31;

/// Stack of children to visit, the next one last. The upper half of an entry is the bits of the
/// squared distance (for positive floats they sort as the numbers do), the lower half is the child.
#[derive(Default)]
pub(crate) struct VisitStack(Vec<u64>);

/// A [`Pyramid`] in single precision.
struct NarrowPyramid {
    apex: [f32; 3],
    outwards: [[f32; 3]; 4],
    /// Margin for the rounding of the position of a corner, metres.
    margin: f32,
}

impl BoxTree {
    /// A tree over boxes. Item `i` is box `i`.
    pub(crate) fn new(boxes: &[Bounds]) -> BoxTree {
        let reach = |b: &Bounds| b.min.abs().max(b.max.abs()).max_element();
        let reach = boxes.iter().map(reach).fold(0.0, f64::max);
        let mut tree = BoxTree { nodes: Vec::new(), reach };
        if !boxes.is_empty() {
            let mut items: Vec<u32> = (0..boxes.len() as u32).collect();
            tree.build(boxes, &mut items);
        }
        tree
    }

    /// Adds a node over some items and returns its index.
    fn build(&mut self, boxes: &[Bounds], items: &mut [u32]) -> u32 {
        let place = self.nodes.len();
        // Unused children have an empty box, which no pyramid meets.
        let (far, near) = (
            [PerChild([f32::INFINITY; CHILDREN]); 3],
            [PerChild([f32::NEG_INFINITY; CHILDREN]); 3],
        );
        self.nodes.push(Node { low: far, high: near, children: [0; CHILDREN] });
        for (i, group) in split(boxes, items, CHILDREN).into_iter().enumerate() {
            let around = around(boxes, group);
            for axis in 0..3 {
                self.nodes[place].low[axis].0[i] = (around.min[axis] as f32).next_down();
                self.nodes[place].high[axis].0[i] = (around.max[axis] as f32).next_up();
            }
            self.nodes[place].children[i] = match *group {
                [item] => item | ITEM,
                _ => self.build(boxes, group),
            };
        }
        place as u32
    }

    /// Visits the items whose boxes a pyramid meets, nearer boxes first. `visit` returns the
    /// distance from the apex beyond which items are not needed, or `None` to stop; then the result
    /// is false. `stack` is working memory, to avoid allocations.
    #[inline(always)]
    pub(crate) fn visit<S: Simd>(
        &self,
        simd: S,
        pyramid: &Pyramid,
        VisitStack(stack): &mut VisitStack,
        mut visit: impl FnMut(u32) -> Option<f64>,
    ) -> bool {
        if self.nodes.is_empty() {
            return true;
        }
        let pyramid = NarrowPyramid::new(pyramid, self.reach);
        let mut limit = f32::INFINITY;
        stack.clear();
        stack.push(0);
        while let Some(next) = stack.pop() {
            let child = next as u32;
            if f32::from_bits((next >> 32) as u32) > limit {
                continue;
            }
            if child & ITEM != 0 {
                match visit(child & !ITEM) {
                    Some(nearer) => limit = pyramid.limit(nearer),
                    None => return false,
                }
                continue;
            }
            let node = &self.nodes[child as usize];
            let (mut met, distances) = node.meets(simd, &pyramid, limit);
            let first = stack.len();
            while met != 0 {
                let i = met.trailing_zeros() as usize % CHILDREN;
                met &= met - 1;
                let child = u64::from(distances[i].to_bits()) << 32 | u64::from(node.children[i]);
                // Sorted by distance, the nearest last: it is taken first.
                stack.push(child);
                let mut place = stack.len() - 1;
                while place > first && stack[place - 1] < child {
                    stack[place] = stack[place - 1];
                    place -= 1;
                }
                stack[place] = child;
            }
        }
        true
    }
}

impl NarrowPyramid {
    /// A coordinate, a difference of two and a product with a component of a unit vector are each
    /// rounded by at most 2⁻²⁴ of twice the largest coordinate. Over three axes the sum is about
    /// 2 × 10⁻⁶ of that coordinate; twice as much is allowed.
    fn new(pyramid: &Pyramid, reach: f64) -> NarrowPyramid {
        let reach = pyramid.apex.abs().max_element().max(reach);
        NarrowPyramid {
            apex: pyramid.apex.as_vec3().to_array(),
            outwards: pyramid.outwards.map(|plane| plane.as_vec3().to_array()),
            margin: (reach * 4e-6) as f32,
        }
    }

    /// The square of a distance, plus the margin.
    fn limit(&self, distance: f64) -> f32 {
        let limit = distance as f32 * (1.0 + 1e-5) + self.margin;
        limit * limit
    }
}

impl Node {
    /// The children whose boxes meet a pyramid, not farther away than the square root of `limit`,
    /// one bit each; and the squared distances of all boxes from the apex.
    #[inline(always)]
    fn meets<S: Simd>(
        &self,
        simd: S,
        pyramid: &NarrowPyramid,
        limit: f32,
    ) -> (u64, [f32; CHILDREN]) {
        let mut square = f32x16::splat(simd, 0.0);
        // For each plane, the signed distance of the innermost corner of each box.
        let mut least = [square; 4];
        for axis in 0..3 {
            let apex = pyramid.apex[axis];
            let low = f32x16::load_array_ref(simd, &self.low[axis].0) - apex;
            let high = f32x16::load_array_ref(simd, &self.high[axis].0) - apex;
            let outside = low.max(-high).max(0.0);
            square += outside * outside;
            for (least, plane) in least.iter_mut().zip(&pyramid.outwards) {
                *least += plane[axis] * if plane[axis] > 0.0 { low } else { high };
            }
        }
        let mut met = square.simd_le(limit);
        for least in least {
            met &= least.simd_le(pyramid.margin);
        }
        (met.to_bitmask(), square.to_array())
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};
    use glam::DVec3;

    use super::*;

    /// Every box that contains a point of a ray, nearer than the limit, is visited.
    #[test]
    fn every_box_that_a_ray_meets_is_visited() {
        let boxes: Vec<Bounds> = (0..500)
            .map(|i| {
                let at = DVec3::new(f64::from(i % 10), f64::from(i / 10 % 10), f64::from(i / 100));
                Bounds { min: at, max: at + 0.7 }
            })
            .collect();
        let tree = BoxTree::new(&boxes);
        let directions: Vec<DVec3> =
            (0..8).map(|i| DVec3::new(1.0, 0.5 + 0.02 * f64::from(i), 0.3).normalize()).collect();
        let frame = [DVec3::X, DVec3::Y, DVec3::Z];
        let apex = DVec3::new(0.35, 0.35, 0.35);
        let pyramid = Pyramid::around(&directions).over(apex, frame);
        for limit in [2.0, 5.0, 100.0] {
            let mut visited = vec![false; boxes.len()];
            dispatch!(Level::new(), simd => {
                tree.visit(simd, &pyramid, &mut VisitStack::default(), |item| {
                    visited[item as usize] = true;
                    Some(limit)
                })
            });
            assert!(visited.iter().filter(|&&v| v).count() < 100, "almost everything is visited");
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
