//! Shooting through the paper's scenes, in bundles and ray by ray, by rays a second.

#![allow(missing_docs, reason = "a benchmark has no users")]

use divan::Bencher;
use divan::counter::ItemsCount;
use lab::{OpenScene, RayBench};
use radiosity::{
    Hemisphere, HemisphereKind, LocalEnvironment, Mask, PatchSize, Rgb, Shot, Source, Space, shoot,
    shoot_plainly,
};
use virtwall::Decomposition;

/// The scenes, and how Table 1 cuts them.
const SCENES: [(&str, [u32; 3]); 3] =
    [("office", [14, 4, 1]), ("rooms", [8, 7, 1]), ("building", [4, 2, 7])];
const RAYS: u32 = 30_976;

/// Sources of a sample that shoots through a whole scene.
const SOURCES: u32 = 16;

fn main() {
    divan::main();
}

fn open(scene: &str) -> OpenScene {
    let path = format!("{}/../../scenes/{scene}.json", env!("CARGO_MANIFEST_DIR"));
    OpenScene::load(&path).expect("the committed scene is right")
}

/// Each scene as one environment, from random points of random polygons.
#[divan::bench(args = SCENES.map(|(name, _)| name), consts = [false, true], sample_count = 10)]
fn whole_scene<const PLAIN: bool>(bencher: Bencher, scene: &str) {
    let bench = RayBench::new(open(scene), SOURCES, RAYS, 1996).expect("so many rays are possible");
    bencher.counter(ItemsCount::new(SOURCES * RAYS)).bench(|| bench.cast(PLAIN));
}

/// Each scene cut into 56 local environments, from a patch of each environment that has one.
#[divan::bench(args = SCENES.map(|(name, _)| name), consts = [false, true], sample_count = 10)]
fn local_environments<const PLAIN: bool>(bencher: Bencher, scene: &str) {
    let cut = SCENES.into_iter().find(|(name, _)| *name == scene).expect("it is one of them").1;
    let open = open(scene);
    let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
    let decomposition = Decomposition::new(open.cells, cut);
    let space = Space::new(open.scene, open.cells);
    let sources: Vec<(LocalEnvironment, Source)> = (0..decomposition.environments())
        .map(|number| LocalEnvironment::new(&space, decomposition.block(number), size))
        .filter_map(|environment| source(&space, &environment).map(|source| (environment, source)))
        .collect();
    let hemisphere =
        Hemisphere::new(HemisphereKind::Fibonacci, RAYS, true).expect("so many rays are possible");
    let mask = Mask::all(RAYS);
    let cast = if PLAIN { shoot_plainly } else { shoot };
    let shots = || -> Vec<Shot> {
        let shots = sources.iter();
        shots.map(|(environment, s)| cast(&space, environment, &hemisphere, s, &mask)).collect()
    };
    bencher.counter(ItemsCount::new(sources.len() as u64 * u64::from(RAYS))).bench(shots);
}

/// The patch in the middle of an environment's list.
fn source(space: &Space, environment: &LocalEnvironment) -> Option<Source> {
    let number = environment.patches.len() / 2;
    let patch = environment.patches.get(number)?;
    Some(Source {
        environment: 0,
        patch: number as u32,
        polygon: patch.polygon,
        centre: patch.centre,
        normal: space.scene.polygons[patch.polygon as usize].plane.normal,
        power: Rgb::ONE,
        radiosity: Rgb::ONE,
    })
}
