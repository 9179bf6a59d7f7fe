//! Closes seams between patches of different sizes: corners of small patches that are on edges of
//! large patches become corners of both (T-junctions are removed).

use glam::DVec3;

/// The vertices of patches with the same orientation, for searches by position.
pub(crate) struct Seams {
    /// Sorted by coordinate, for each axis.
    sorted: [Vec<u32>; 3],
}

impl Seams {
    /// Sorts vertices, which may be in several parallel planes.
    pub(crate) fn of(vertices: &[u32], positions: &[DVec3]) -> Seams {
        let sort = |axis: usize| {
            let mut sorted = vertices.to_vec();
            sorted.sort_by(|&a, &b| {
                positions[a as usize][axis].total_cmp(&positions[b as usize][axis])
            });
            sorted
        };
        Seams { sorted: [sort(0), sort(1), sort(2)] }
    }

    /// The corners of an outline, with all vertices on its edges inserted.
    pub(crate) fn stitch(&self, corners: &[u32], positions: &[DVec3], step: f64) -> Vec<u32> {
        let next = corners.iter().cycle().skip(1);
        let edges = corners.iter().zip(next);
        edges
            .flat_map(|(&from, &to)| {
                let inner = self.on_edge([from, to], positions, step);
                std::iter::once(from).chain(inner)
            })
            .collect()
    }

    /// Vertices on an edge, without its ends, in order.
    fn on_edge(&self, ends: [u32; 2], positions: &[DVec3], step: f64) -> Vec<u32> {
        let [from, to] = ends.map(|end| positions[end as usize]);
        let edge = to - from;
        let length = edge.length();
        let slab = |axis: usize| {
            let sorted = &self.sorted[axis];
            let (low, high) = (from[axis].min(to[axis]) - step, from[axis].max(to[axis]) + step);
            let first = sorted.partition_point(|&v| positions[v as usize][axis] < low);
            let last = sorted.partition_point(|&v| positions[v as usize][axis] <= high);
            &sorted[first..last]
        };
        // The axis along which the fewest vertices are within the extent of the edge.
        let few = [slab(0), slab(1), slab(2)].into_iter().min_by_key(|slab| slab.len());
        let along = |vertex: u32| (positions[vertex as usize] - from).dot(edge) / length;
        let lies_on = |&vertex: &u32| {
            let along = along(vertex);
            let off = positions[vertex as usize] - from - edge * (along / length);
            along > step && along < length - step && off.length() <= step
        };
        let mut inner: Vec<u32> = few.unwrap_or_default().iter().copied().filter(lies_on).collect();
        inner.sort_by(|&a, &b| along(a).total_cmp(&along(b)));
        inner
    }
}
