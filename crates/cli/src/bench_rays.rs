//! `virtwall bench rays`: how many rays a second the kernel casts, on any OBJ, so that anyone can hold
//! it against another tracer on the same file.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lab::{HostClock, OpenScene, RayBench};
use radiosity::{Operation, Work};

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
    let bench = RayBench::new(open, arguments.sources, arguments.rays, arguments.seed)
        .map_err(Exit::bad_input)?;
    let clock = HostClock::start();
    let work = bench.cast_on(arguments.threads as usize, arguments.plain);
    let seconds = clock.seconds();
    Ok(report(arguments, bench.space.scene.polygons.len(), &work, seconds))
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
