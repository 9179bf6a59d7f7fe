//! The corners of a patch. Shooting does not need them; exact solutions and pictures do.

use glam::DVec3;

use super::environment::LocalEnvironment;
use super::patch::Patch;
use super::piece::Leaf;
use super::space::Space;
use crate::geometry::{area_and_centroid, clip_to_box, clip_to_slab};

impl LocalEnvironment {
    /// Corners of a patch, counter-clockwise seen from the front, metres: the part of its polygon
    /// inside its slots and this environment. Empty for a patch without area.
    pub fn outline(&self, space: &Space, patch: u32) -> Vec<DVec3> {
        let Patch { centre, area, polygon } = self.patches[patch as usize];
        let Some(piece) = self.piece(polygon).filter(|_| area > 0.0) else { return Vec::new() };
        let piece = &self.pieces[piece as usize];
        let polygon = &space.scene.polygons[polygon as usize];
        let corners: Vec<DVec3> = space.scene.corners(polygon).collect();
        let all = clip_to_box(&corners, &space.grid.bounds(&self.block));
        let leaf = |Leaf { first, side }: Leaf| {
            let [i, j, side] = [first[0], first[1], side].map(f64::from);
            let row = clip_to_slab(&all, piece.v, piece.v0 + j, piece.v0 + j + side);
            clip_to_slab(&row, piece.u, piece.u0 + i, piece.u0 + i + side)
        };
        if let Some(&several) = self.leaves.get(patch as usize) {
            return leaf(several);
        }
        let part = |slot: [u32; 2]| leaf(Leaf { first: slot, side: 1 });
        // Its own slot has its centre. After rounding that can be in a neighbour, which has no area of it.
        let near = |along: DVec3, start: f64, n: u32| {
            let slot = ((centre.dot(along) - start).max(0.0) as u32).min(n - 1);
            slot.saturating_sub(1)..(slot + 2).min(n)
        };
        let (columns, rows) =
            (near(piece.u, piece.u0, piece.nu), near(piece.v, piece.v0, piece.nv));
        let slots = rows.flat_map(|j| columns.clone().map(move |i| [i, j]));
        let own = slots
            .filter(|[i, j]| self.slots[(piece.first_slot + j * piece.nu + i) as usize] == patch);
        let off = |outline: &Vec<DVec3>| (area_and_centroid(outline).0 - area).abs();
        own.map(part).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::area_and_centroid;
    use crate::{Face, LocalEnvironment, Material, PatchSize, Scene, Space};
    use glam::DVec3;

    /// Outlines have the areas and centroids of their patches, also when cut by interfaces.
    #[test]
    fn outlines_are_those_of_the_patches() {
        let points = [[0.0, 0.0, 0.0], [3.0, 0.5, 1.0], [2.0, 2.0, 1.0], [0.5, 1.0, 0.2]];
        let points = points.map(DVec3::from);
        let face = |points: &[DVec3]| Face { points: points.to_vec(), material: 0, object: 0 };
        let faces = [face(&points[..3]), face(&[points[0], points[2], points[3]])];
        let material = Material { two_sided: true, ..Material::default() };
        let scene = Scene::new(&faces, vec![material], vec!["object".to_owned()]).unwrap().0;
        let space = Space::new(scene, [4, 2, 2]);
        let mut cut = space.grid.whole();
        cut.high[0] = 2;
        for block in [space.grid.whole(), cut] {
            let size = PatchSize { reflector: 0.3, emitter: 0.3 };
            let environment = LocalEnvironment::new(&space, block, size);
            assert!(environment.patches.len() > 20);
            for (number, patch) in (0..).zip(&environment.patches) {
                let (area, centre) = area_and_centroid(&environment.outline(&space, number));
                assert!((area - patch.area).abs() < 1e-12, "{area} {patch:?}");
                assert!(patch.area < 1e-12 || centre.distance(patch.centre) < 1e-9, "{patch:?}");
            }
        }
    }
}
