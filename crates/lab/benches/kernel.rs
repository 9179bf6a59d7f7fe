//! Shooting through the paper's scenes, in bundles and ray by ray, by rays a second.

#![allow(missing_docs, reason = "a benchmark has no users")]

use divan::Bencher;
use divan::counter::ItemsCount;
use lab::{OpenScene, RayBench};
use radiosity::{
    Emitter, Hemisphere, HemisphereKind, LocalEnvironment, Mask, PatchSize, Rgb, Shot, Space,
    shoot, shoot_plainly,
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

/// How the rays of a source are cast.
type Cast = fn(&Space, &LocalEnvironment, &Hemisphere, &Emitter, &Mask) -> Shot;

/// Each scene as one environment, from random points of random polygons.
mod whole_scene {
    use super::*;

    #[divan::bench(args = names(), sample_count = 10)]
    fn bundles(bencher: Bencher, scene: &str) {
        cast(bencher, scene, false);
    }

    #[divan::bench(args = names(), sample_count = 10)]
    fn plainly(bencher: Bencher, scene: &str) {
        cast(bencher, scene, true);
    }

    fn cast(bencher: Bencher, scene: &str, plain: bool) {
        let bench = RayBench::new(open(scene), SOURCES, RAYS, 1996)
            .expect("this number of rays is possible");
        bencher.counter(ItemsCount::new(SOURCES * RAYS)).bench(|| bench.cast(plain));
    }
}

/// Each scene cut into 56 local environments, from a patch of each environment that has one.
mod local_environments {
    use super::*;

    #[divan::bench(args = names(), sample_count = 10)]
    fn bundles(bencher: Bencher, scene: &str) {
        cast_each(bencher, scene, shoot);
    }

    #[divan::bench(args = names(), sample_count = 10)]
    fn plainly(bencher: Bencher, scene: &str) {
        cast_each(bencher, scene, shoot_plainly);
    }
}

fn names() -> impl Iterator<Item = &'static str> {
    SCENES.into_iter().map(|(name, _)| name)
}

fn cast_each(bencher: Bencher, scene: &str, cast: Cast) {
    let cut = SCENES.into_iter().find(|(name, _)| *name == scene).expect("it is one of them").1;
    let open = open(scene);
    let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
    let decomposition = Decomposition::new(open.cells, cut);
    let space = Space::new(open.scene, open.cells);
    let sources: Vec<(LocalEnvironment, Emitter)> = (0..decomposition.environments())
        .map(|number| LocalEnvironment::new(&space, decomposition.block(number), size))
        .filter_map(|environment| source(&space, &environment).map(|source| (environment, source)))
        .collect();
    let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, RAYS, true)
        .expect("this number of rays is possible");
    let mask = Mask::all(RAYS);
    let shots = || -> Vec<Shot> {
        let shots = sources.iter();
        shots.map(|(environment, s)| cast(&space, environment, &hemisphere, s, &mask)).collect()
    };
    bencher.counter(ItemsCount::new(sources.len() as u64 * u64::from(RAYS))).bench(shots);
}

/// The patch in the middle of an environment's list.
fn source(space: &Space, environment: &LocalEnvironment) -> Option<Emitter> {
    let number = environment.patches.len() / 2;
    let patch = environment.patches.get(number)?;
    Some(Emitter {
        environment: 0,
        patch: number as u32,
        polygon: patch.polygon,
        centre: patch.centre,
        normal: space.scene.polygons[patch.polygon as usize].plane.normal,
        power: Rgb::ONE,
        radiosity: Rgb::ONE,
    })
}
