//! The kernel compared with Embree: the same rays from the same points through the same scene.

use std::fmt::Write;

use lab::{OpenScene, RayBench};
use radiosity::Operation;
use radiosity::glam::DVec3;
use serde::Serialize;

use crate::cpu::{Spread, rounded, timed};
use crate::peer::{Peer, Program, Recipe};
use crate::scenes::BenchScene;

pub const EMBREE: Recipe = Recipe {
    name: "embree",
    source: include_str!("../cpp/embree.cpp"),
    library: "embree3",
    packages: "g++ libembree-dev",
};

/// Sources, rays from each, and the seed of the points; the same as in `virtwall bench rays`.
const SOURCES: u32 = 64;
const RAYS: u32 = 30_976;
const SEED: u64 = 1996;

/// Modes of Embree: name, rays per call, robust.
const MODES: [(&str, u32, bool); 6] = [
    ("single", 1, false),
    ("packets of 8", 8, false),
    ("packets of 16", 16, false),
    ("robust, single", 1, true),
    ("robust, packets of 8", 8, true),
    ("robust, packets of 16", 16, true),
];

/// One ray tracer on one scene.
#[derive(Serialize)]
pub struct Row {
    pub scene: String,
    pub polygons: usize,
    /// The tracer and its mode.
    pub tracer: String,
    /// Rays cast.
    pub rays: u64,
    /// Rays that ended on a polygon.
    pub hits: u64,
    /// Hits on the polygon on which the ray starts.
    pub own_hits: u64,
    /// Million rays per second of one thread: median, least and greatest of the rounds.
    pub mrays_per_second: f64,
    pub least: f64,
    pub greatest: f64,
    /// The median of this project relative to that of the row.
    pub ours_over_this: f64,
}

/// Measures a scene: after a warm-up round, `rounds` rounds in which each tracer casts all rays once.
pub fn measure(embree: &Program, scene: &BenchScene, rounds: u16) -> Result<Vec<Row>, String> {
    let open = OpenScene::load(&scene.path.to_string_lossy()).map_err(|fault| fault.to_string())?;
    let bench = RayBench::new(open, SOURCES, RAYS, SEED).map_err(|error| error.to_string())?;
    let mut embree = Peer::start(embree, &[])?;
    embree.write(&problem(&bench))?;
    let version = embree.line()?;
    // For each tracer the counts, equal in all rounds, and the rate of each round.
    let mut counts = vec![(0, 0, 0); 1 + MODES.len()];
    let mut rates = vec![Vec::new(); 1 + MODES.len()];
    for round in 0..=rounds {
        for tracer in 0..=MODES.len() {
            let (count, seconds) = match tracer {
                0 => ours(&bench),
                _ => theirs(&mut embree, &bench, MODES[tracer - 1])?,
            };
            counts[tracer] = count;
            if round > 0 {
                rates[tracer].push(count.0 as f64 / seconds / 1e6);
            }
        }
    }
    let names = MODES.iter().map(|(name, ..)| format!("Embree {version}, {name}"));
    let names = std::iter::once("Virtwall, bundles".to_owned()).chain(names);
    let spreads: Vec<Spread> = rates.into_iter().map(Spread::of).collect();
    let rows =
        names.zip(counts).zip(&spreads).map(|((tracer, (rays, hits, own_hits)), &rate)| Row {
            scene: scene.name.clone(),
            polygons: bench.space.scene.polygons.len(),
            tracer,
            rays,
            hits,
            own_hits,
            mrays_per_second: rounded(rate.median),
            least: rounded(rate.least),
            greatest: rounded(rate.greatest),
            ours_over_this: rounded(spreads[0].median / rate.median),
        });
    Ok(rows.collect())
}

/// The rows of a scene as a Markdown table.
pub fn table(rows: &[Row]) -> String {
    let mut text = String::new();
    if let Some(Row { scene, polygons, rays, .. }) = rows.first() {
        text += &format!("\n{scene}: {polygons} polygons, {rays} rays a round\n\n");
        text += "| tracer | Mrays/s | least–greatest | hits | of these on the source's own polygon | misses | ours/this |\n|---|---:|---:|---:|---:|---:|---:|\n";
    }
    for row in rows {
        let Row { tracer, rays, hits, own_hits, mrays_per_second, least, greatest, .. } = row;
        let (misses, ratio) = (rays - hits, row.ours_over_this);
        text += &format!(
            "| {tracer} | {mrays_per_second:.1} | {least:.1}–{greatest:.1} | {hits} | {own_hits} | {misses} | {ratio:.2} |\n"
        );
    }
    text
}

/// Rays, hits, hits on the source's own polygon.
type Count = (u64, u64, u64);

fn ours(bench: &RayBench) -> (Count, f64) {
    let (work, seconds) = timed(|| bench.cast(false));
    ((work.of(Operation::Ray), work.of(Operation::Hit), 0), seconds)
}

fn theirs(
    embree: &mut Peer,
    bench: &RayBench,
    (_, width, robust): (&str, u32, bool),
) -> Result<(Count, f64), String> {
    embree.write(&format!("{width} {}\n", u32::from(robust)))?;
    let (seconds, hits, own_hits) = embree.figures()?;
    let rays = bench.sources.len() as u64 * u64::from(bench.hemisphere.pixels());
    Ok(((rays, hits, own_hits), seconds))
}

/// Polygons, directions and sources in the format that `embree.cpp` reads, in local coordinates of the scene,
/// rounded to single precision.
fn problem(bench: &RayBench) -> String {
    let mut text = String::new();
    let scene = &bench.space.scene;
    put(&mut text, &format_args!("{}\n", scene.polygons.len()));
    for polygon in &scene.polygons {
        put(&mut text, &polygon.vertices.len());
        scene.corners(polygon).for_each(|corner| vector(&mut text, corner));
    }
    let mut directions = bench.hemisphere.directions.clone();
    directions.sort_by_key(|d| along_z_curve(*d));
    put(&mut text, &directions.len());
    directions.into_iter().for_each(|direction| vector(&mut text, direction));
    put(&mut text, &bench.sources.len());
    for source in &bench.sources {
        put(&mut text, &source.polygon);
        vector(&mut text, source.centre);
        let frame = bench.hemisphere.frame(source.centre, source.normal);
        frame.into_iter().for_each(|axis| vector(&mut text, axis));
    }
    text
}

/// The position of a direction on a Z-order curve over the disc, which makes packets of any width coherent.
fn along_z_curve(direction: DVec3) -> u64 {
    let cell = |x: f64| ((x + 1.0) * f64::from(1 << 15)) as u64;
    let (x, y) = (cell(direction.x), cell(direction.y));
    (0..17)
        .fold(0, |code, bit| code | (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1))
}

fn vector(text: &mut String, v: DVec3) {
    let [x, y, z] = v.as_vec3().to_array();
    put(text, &format_args!("{x} {y} {z}"));
}

fn put(text: &mut String, words: &dyn std::fmt::Display) {
    writeln!(text, "{words}").expect("writing to a String does not fail");
}
