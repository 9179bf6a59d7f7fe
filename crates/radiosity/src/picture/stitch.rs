//! Where patches of different sizes meet, corners of the small ones lie on edges of the large ones:
//! these become corners of both, so that no seam shows.

use glam::DVec3;

/// Vertices of one plane's patches, to be looked up by where they are.
pub(crate) struct Seams {
    /// By coordinate along each axis.
    sorted: [Vec<u32>; 3],
}

impl Seams {
    /// Of these vertices, which may lie in several parallel planes.
    pub(crate) fn of(vertices: &[u32], positions: &[DVec3]) -> Seams {
        let along = |axis: usize| {
            let mut sorted = vertices.to_vec();
            sorted.sort_by(|&a, &b| {
                positions[a as usize][axis].total_cmp(&positions[b as usize][axis])
            });
            sorted
        };
        Seams { sorted: [along(0), along(1), along(2)] }
    }

    /// Puts the vertices that lie on the edges between these corners where they lie.
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

    /// Vertices on an edge without its ends, from end to end.
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
        // Along an axis that the edge hardly extends along there are the fewest.
        let few = [slab(0), slab(1), slab(2)].into_iter().min_by_key(|slab| slab.len());
        let way = |vertex: u32| (positions[vertex as usize] - from).dot(edge) / length;
        let lies_on = |&vertex: &u32| {
            let way = way(vertex);
            let off = positions[vertex as usize] - from - edge * (way / length);
            way > step && way < length - step && off.length() <= step
        };
        let mut inner: Vec<u32> = few.unwrap_or_default().iter().copied().filter(lies_on).collect();
        inner.sort_by(|&a, &b| way(a).total_cmp(&way(b)));
        inner
    }
}
