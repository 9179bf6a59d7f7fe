//! How well rays know form factors: bars, and the order in which they converge to what is exact.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::path::Path;

use lab::OpenScene;
use radiosity::glam::DVec3;
use radiosity::{
    Emitter, Hemisphere, HemisphereKind, LocalEnvironment, Mask, PatchSize, Rgb, Space, shoot,
};
use reference::{Pair, Patches, Tolerance};
use virtwall::SourceSplit;

/// The empty room of 4 × 4 × 3 m in patches of half a metre.
struct Room {
    space: Space,
    environment: LocalEnvironment,
    patches: Patches,
}

impl Room {
    fn open() -> Room {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/room4.json");
        let open = OpenScene::load(path.to_str().unwrap()).unwrap();
        let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
        let space = Space::new(open.scene, open.cells);
        let environment = LocalEnvironment::new(&space, space.grid.whole(), size);
        let patches = Patches::new(&space, &environment);
        assert_eq!(patches.count(), 320);
        Room { space, environment, patches }
    }

    /// Every seventh patch: of all columns and rows of a wall, eight patches wide, alike.
    fn sources() -> impl Iterator<Item = u32> {
        (0..320).step_by(7)
    }

    /// Form factors from a patch to all, by rays from the parts that it is cut into.
    fn by_rays(&self, patch: u32, hemisphere: &Hemisphere, split: SourceSplit) -> Vec<f64> {
        let mut found = vec![0.0; self.patches.count()];
        let polygon = self.environment.patches[patch as usize].polygon;
        for part in split.parts(&self.space, &self.environment, patch) {
            let source = Emitter {
                environment: 0,
                patch,
                polygon,
                centre: part.centre,
                normal: self.space.scene.polygons[polygon as usize].plane.normal,
                power: Rgb::ONE,
                radiosity: Rgb::ONE,
            };
            let mask = Mask::all(hemisphere.pixels());
            let shot = shoot(&self.space, &self.environment, hemisphere, &source, &mask);
            shot.hits.iter().for_each(|&(hit, f)| found[hit as usize] += part.share * f);
        }
        found
    }

    /// The same as `of` each pair says, whose patches see each other.
    fn exactly(&self, patch: u32, of: impl Fn(&Pair) -> f64) -> Vec<f64> {
        let surfaces = &self.patches.surfaces;
        let from = &surfaces[patch as usize];
        let pair = |to| Pair::new(&self.space.scene, from, to).map_or(0.0, |pair| of(&pair));
        surfaces.iter().map(pair).collect()
    }

    /// From the patch's centre, by Lambert's contour integral.
    fn of_centre(&self, patch: u32) -> Vec<f64> {
        let centre: DVec3 = self.environment.patches[patch as usize].centre;
        self.exactly(patch, |pair| pair.from_element(centre))
    }

    /// From all of the patch.
    fn of_area(&self, patch: u32) -> Vec<f64> {
        let area = self.patches.areas[patch as usize];
        let tolerance = Tolerance { absolute: 1e-7, relative: 1e-5 };
        self.exactly(patch, |pair| pair.exchange(tolerance).value / area)
    }

    /// The part of the energy of the sources, on average, that `split` and this number of rays send elsewhere
    /// than `exact` says.
    fn misdirected(&self, pixels: u32, split: SourceSplit, exact: &[Vec<f64>]) -> f64 {
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, pixels, true).unwrap();
        let of = |(patch, exact): (u32, &Vec<f64>)| {
            let found = self.by_rays(patch, &hemisphere, split);
            found.iter().zip(exact).map(|(found, exact)| (found - exact).abs()).sum::<f64>() / 2.0
        };
        Room::sources().zip(exact).map(of).sum::<f64>() / exact.len() as f64
    }
}

/// The exponent of the power law through points, by least squares of logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = || points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let (mx, my) = logs().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let both = logs().map(|(x, y)| (x - mx) * (y - my)).sum::<f64>();
    both / logs().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}

/// The default hemisphere sends at most half a per cent of a centre's energy elsewhere, and the error
/// falls with the power 0.79 of the rays.
#[test]
fn directions_err_little_and_less_with_more() {
    let room = Room::open();
    let exact: Vec<_> = Room::sources().map(|patch| room.of_centre(patch)).collect();
    for row in &exact {
        assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    }
    let misdirected = |pixels| room.misdirected(pixels, SourceSplit::NONE, &exact);
    let default = misdirected(30_976);
    assert!(default < 0.005, "{default}");
    let rays = [32_u32, 64, 128, 256].map(|side| side * side);
    let points = rays.map(|rays| (f64::from(rays), misdirected(rays)));
    let exponent = exponent(&points);
    println!("{default} {points:?} {exponent}");
    assert!((-0.90..=-0.74).contains(&exponent), "{exponent} {points:?}");
}

/// All causes together, averaged over patches in corners as well: shooting from centres costs more than
/// the rays do; sources cut where something is near come below 0.3 %.
#[test]
fn cut_sources_err_little_in_all() {
    let room = Room::open();
    let exact: Vec<_> = Room::sources().map(|patch| room.of_area(patch)).collect();
    let [whole, quarters, adaptive] =
        [(f64::INFINITY, 1), (f64::INFINITY, 2), (3.0, 4)].map(|(nearer_than, most)| {
            room.misdirected(30_976, SourceSplit { nearer_than, most }, &exact)
        });
    println!("{whole} {quarters} {adaptive}");
    assert!(adaptive < 0.003 && quarters < whole / 3.0, "{whole} {quarters} {adaptive}");
    assert!((0.010..0.020).contains(&whole), "{whole}");
}
