//! `virtwall bench rays`: how many rays a second the kernel casts, on any OBJ, so that anyone can hold
//! it against another tracer on the same file.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lab::{HostClock, OpenScene};
use radiosity::glam::DVec3;
use radiosity::{
    Hemisphere, HemisphereKind, LocalEnvironment, Mask, Operation, PatchSize, Rgb, Source, Space,
    Work, shoot, shoot_plainly,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::exit::Exit;

/// What to cast.
#[derive(Args)]
pub struct Arguments {
    /// An OBJ file, or the name or description of a scene.
    scene: PathBuf,
    /// Sources: random points of random faces.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    sources: u32,
    /// Cosine-weighted rays from each source.
    #[arg(long, value_name = "N", default_value_t = 30_976, value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    rays: u32,
    /// Threads.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    /// Seed of the random points.
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
    /// Cast a ray at a time, polygon by polygon: the oracle of the fast path.
    #[arg(long)]
    plain: bool,
    /// How to print what was measured.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// Casts, and returns what was measured. Setting a source up and counting what the virtual processor
/// does are part of the time; reading the file and sorting it into its grid are not.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let open = OpenScene::load(&arguments.scene.to_string_lossy())?;
    let space = Space::new(open.scene, open.cells);
    let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
    let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
    let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, arguments.rays, true)
        .map_err(Exit::bad_input)?;
    let mut random = ChaCha8Rng::seed_from_u64(arguments.seed);
    let sources: Vec<Source> =
        (0..arguments.sources).map(|_| random_source(&space, &mut random)).collect();
    let mask = Mask::all(hemisphere.pixels());
    let cast = if arguments.plain { shoot_plainly } else { shoot };
    let clock = HostClock::start();
    let work = std::thread::scope(|scope| {
        let share = sources.len().div_ceil(arguments.threads as usize);
        let threads: Vec<_> = sources
            .chunks(share)
            .map(|sources| {
                let shots = || sources.iter().map(|s| cast(&space, &whole, &hemisphere, s, &mask));
                scope.spawn(move || shots().fold(Work::NONE, |work, shot| work + shot.work))
            })
            .collect();
        threads.into_iter().try_fold(Work::NONE, |sum, thread| Some(sum + thread.join().ok()?))
    });
    let seconds = clock.seconds();
    let work = work.ok_or_else(|| Exit::failure("a thread failed"))?;
    Ok(report(arguments, space.scene.polygons.len(), &work, seconds))
}

/// A random point of a random polygon, as a source.
fn random_source(space: &Space, random: &mut ChaCha8Rng) -> Source {
    let polygon = random.random_range(0..space.scene.polygons.len());
    let face = &space.scene.polygons[polygon];
    let corners: Vec<DVec3> = space.scene.corners(face).collect();
    // A random triangle of the fan, then a random point of it.
    let corner = random.random_range(1..corners.len() - 1);
    let (mut a, mut b) = (random.random::<f64>(), random.random::<f64>());
    if a + b > 1.0 {
        (a, b) = (1.0 - a, 1.0 - b);
    }
    let [p, q, r] = [corners[0], corners[corner], corners[corner + 1]];
    Source {
        environment: 0,
        patch: 0,
        polygon: polygon as u32,
        centre: p + (q - p) * a + (r - p) * b,
        normal: face.plane.normal,
        power: Rgb::ONE,
        radiosity: Rgb::ONE,
    }
}

fn report(arguments: &Arguments, polygons: usize, work: &Work, seconds: f64) -> String {
    let (rays, hits) = (work.of(Operation::Ray), work.of(Operation::Hit));
    let rate = rays as f64 / seconds;
    match arguments.format {
        Format::Text => format!(
            "{rays} rays at {polygons} polygons in {seconds:.3} s: {:.1} million a second; {hits} hits, {} misses\n",
            rate / 1e6,
            rays - hits
        ),
        Format::Json => {
            let measured = serde_json::json!({
                "polygons": polygons,
                "sources": arguments.sources,
                "threads": arguments.threads,
                "seed": arguments.seed,
                "rays": rays,
                "hits": hits,
                "misses": rays - hits,
                "seconds": seconds,
                "rays_per_second": rate,
            });
            format!("{measured}\n")
        }
    }
}
