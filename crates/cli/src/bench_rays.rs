//! `virtwall bench rays`: how many rays per second the kernel casts in a scene, to compare with other ray
//! tracers on the same file.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lab::{HostClock, OpenScene, RayBench};
use radiosity::{Operation, Work};

use crate::exit::{Exit, print_warnings};

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, or path to a scene description (.json) or an OBJ file
    scene: PathBuf,
    /// Number of sources: random points on random faces
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    sources: u32,
    /// Cosine-weighted rays from each source
    #[arg(long, value_name = "N", default_value_t = 30_976, value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    rays: u32,
    /// Threads
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    /// Seed of the random points
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
    /// Cast rays one by one with the simple kernel, the oracle of the fast one
    #[arg(long)]
    plain: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// Casts, and returns what was measured. The time includes preparing each source and counting operations
/// for the virtual processor; it does not include reading the file and building the grid.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let open = OpenScene::load(&arguments.scene.to_string_lossy())?;
    print_warnings(&open.warnings);
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
            "{rays} rays at {polygons} polygons in {seconds:.3} s: {:.1} million per second; {hits} hits, {} misses\n",
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
