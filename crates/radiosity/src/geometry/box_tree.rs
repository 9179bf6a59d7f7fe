//! A tree of boxes over the polygons of an environment: which of them a bundle of rays can meet.
//!
//! It only saves the host time. What it leaves out no ray of the bundle hits; what the virtual
//! processor is charged for is the walk through the grid. So single precision will do, with room for
//! its rounding.

use fearless_simd::f32x16;
use fearless_simd::prelude::*;

use super::bounds::Bounds;
use super::pyramid::Pyramid;
use super::split::{around, split};

/// Children of a node.
const WIDE: usize = 16;

/// A bounding volume hierarchy of nodes with up to sixteen children, the root first.
#[derive(Default)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// The greatest coordinate of a box, either way.
    reach: f64,
}

/// A number for each child of a node.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Each([f32; WIDE]);

/// The boxes of a node's children, coordinate by coordinate, so that all are tested at a time.
struct Node {
    low: [Each; 3],
    high: [Each; 3],
    /// Items, with [`ITEM`], or nodes.
    children: [u32; WIDE],
}

const ITEM: u32 = 1 << 31;

/// Children to be visited, the next one last: the square of its distance, whose bits sort as it does,
/// over the child.
#[derive(Default)]
pub(crate) struct Waiting(Vec<u64>);

/// A pyramid in single precision.
struct Narrow {
    apex: [f32; 3],
    outwards: [[f32; 3]; 4],
    /// How far rounding can put the corner of a box on the wrong side of a plane, metres.
    room: f32,
}

impl Tree {
    /// A tree over boxes; item `i` is box `i`.
    pub(crate) fn new(boxes: &[Bounds]) -> Tree {
        let reach = |b: &Bounds| b.min.abs().max(b.max.abs()).max_element();
        let reach = boxes.iter().map(reach).fold(0.0, f64::max);
        let mut tree = Tree { nodes: Vec::new(), reach };
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
        let (far, near) = ([Each([f32::INFINITY; WIDE]); 3], [Each([f32::NEG_INFINITY; WIDE]); 3]);
        self.nodes.push(Node { low: far, high: near, children: [0; WIDE] });
        for (i, group) in split(boxes, items, WIDE).into_iter().enumerate() {
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

    /// Visit the items whose boxes a pyramid meets, nearer boxes first. A visit returns the distance
    /// from the apex beyond which no more are wanted, or `None` to go no further; whether all were
    /// visited. `waiting` is room to work in, kept by the caller so that no visit asks for memory.
    #[inline(always)]
    pub(crate) fn visit<S: Simd>(
        &self,
        simd: S,
        pyramid: &Pyramid,
        Waiting(waiting): &mut Waiting,
        mut visit: impl FnMut(u32) -> Option<f64>,
    ) -> bool {
        if self.nodes.is_empty() {
            return true;
        }
        let pyramid = Narrow::new(pyramid, self.reach);
        let mut limit = f32::INFINITY;
        waiting.clear();
        waiting.push(0);
        while let Some(next) = waiting.pop() {
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
            let first = waiting.len();
            while met != 0 {
                let i = met.trailing_zeros() as usize % WIDE;
                met &= met - 1;
                let child = u64::from(distances[i].to_bits()) << 32 | u64::from(node.children[i]);
                // Nearest last, to be taken first.
                waiting.push(child);
                let mut place = waiting.len() - 1;
                while place > first && waiting[place - 1] < child {
                    waiting[place] = waiting[place - 1];
                    place -= 1;
                }
                waiting[place] = child;
            }
        }
        true
    }
}

impl Narrow {
    /// A coordinate, a difference of two and a product with a component of a unit vector are each
    /// rounded by 2⁻²⁴ of at most twice the greatest coordinate: some 2 × 10⁻⁶ of it for all three
    /// axes.
    fn new(pyramid: &Pyramid, reach: f64) -> Narrow {
        let reach = pyramid.apex.abs().max_element().max(reach);
        Narrow {
            apex: pyramid.apex.as_vec3().to_array(),
            outwards: pyramid.outwards.map(|plane| plane.as_vec3().to_array()),
            room: (reach * 4e-6) as f32,
        }
    }

    /// The square of a distance, with room.
    fn limit(&self, distance: f64) -> f32 {
        let limit = distance as f32 * (1.0 + 1e-5) + self.room;
        limit * limit
    }
}

impl Node {
    /// Children whose boxes meet a pyramid no farther away than the root of `limit`, a bit each, and
    /// the squares of the distances of all boxes from the apex.
    #[inline(always)]
    fn meets<S: Simd>(&self, simd: S, pyramid: &Narrow, limit: f32) -> (u64, [f32; WIDE]) {
        let mut square = f32x16::splat(simd, 0.0);
        // How far inside each of the four planes the corner lies that is farthest so.
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
            met &= least.simd_le(pyramid.room);
        }
        (met.to_bitmask(), square.to_array())
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};
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
            dispatch!(Level::new(), simd => {
                tree.visit(simd, &pyramid, &mut Waiting::default(), |item| {
                    visited[item as usize] = true;
                    Some(limit)
                })
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
