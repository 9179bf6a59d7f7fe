//! `virtwall reference`: computes a reference solution of a scene, with its error, and stores it.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use lab::OpenScene;
use radiosity::{LocalEnvironment, Space};
use reference::{
    Dense, Method, NoReference, Patches, Paths, Problem, Received, Reference, Subject,
};
use serde::{Deserialize, Serialize};

use crate::exit::{Exit, print_warnings};
use crate::files::{check_writable, make_folder, write};
use crate::scene::meshed;
use crate::steps::Steps;
use crate::threads::Threads;

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, or path to a scene description (.json) or an OBJ file
    scene: String,
    /// Method [default: dense up to 1,000 patches, else paths]
    #[arg(long, value_enum)]
    method: Option<MethodArgument>,
    /// Error tolerance of the sum of a patch's form factors, for the dense method
    #[arg(long, value_name = "ERROR", default_value = "1e-4", value_parser = crate::formfactors::tolerance)]
    tolerance: f64,
    /// Problem that paths solve
    #[arg(long, value_enum, default_value = "patches")]
    problem: ProblemArgument,
    /// Approximate number of paths from the lights
    #[arg(long, value_name = "N", default_value_t = 1 << 22, value_parser = clap::value_parser!(u64).range(1..=1 << 36))]
    paths: u64,
    /// Seed of the paths
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
    /// File to write [default: results/references/<name of the scene>.<format>]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// File format: JSON with all data, or CSV with a line per patch
    #[arg(long, value_enum, default_value = "json")]
    format: Format,
    #[command(flatten)]
    threads: Threads,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum MethodArgument {
    /// Form factors between all patches, by adaptive quadrature with exact shadows
    Dense,
    /// Paths of light from the lights; an interrupted computation is resumed
    Paths,
}

#[derive(Clone, Copy, ValueEnum)]
enum ProblemArgument {
    /// Each patch has one radiosity: the radiosity system on this mesh, as in the dense method
    Patches,
    /// Light is reflected from where it falls; the mesh only serves to average it
    Continuum,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Json,
    Csv,
}

/// The most patches for which the dense method is the default.
const DENSE: usize = 1_000;
/// The most patches whose matrices fit an ordinary host.
const MOST_DENSE: usize = 10_000;
/// Rounds of paths: enough to know their standard error within 10 %.
const ROUNDS: u32 = 64;

struct Meshed {
    space: Space,
    environment: LocalEnvironment,
    patches: Patches,
    threads: usize,
}

/// Partial results of paths, saved after some rounds, so that a killed computation loses only those.
#[derive(Serialize, Deserialize)]
struct Partial {
    subject: Subject,
    received: Received,
}

/// Computes and stores; returns what was done.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let open = OpenScene::load(&arguments.scene)?.without_media()?;
    print_warnings(open.all_warnings());
    let refuse = |error: NoReference| Exit::bad_input(format!("{}: {error}", arguments.scene));
    if !open.scene.may_reflect_light() {
        return Err(refuse(NoReference::Dark));
    }
    let (space, environment) = meshed(&open);
    let patches = Patches::new(&space, &environment);
    let threads = arguments.threads.count();
    let (method, problem) = chosen(arguments, patches.count())?;
    let stem = Path::new(&arguments.scene).file_stem().unwrap_or_default().to_string_lossy();
    let subject = Subject {
        scene: stem.into_owned(),
        patches_sha256: patches.digest(),
        patch_size_m: open.patch_size,
        emitter_patch_size_m: open.emitter_patch_size,
        cells: open.cells,
        problem,
        method,
    };
    let output = output_file(arguments, &subject.scene)?;
    check_writable(&output)?;
    let mut partial = output.as_os_str().to_owned();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    let meshed = Meshed { space, environment, patches, threads };
    let found = match subject.method {
        Method::Dense { tolerance } => meshed.dense(subject, tolerance),
        Method::Paths { .. } => meshed.paths(subject, &partial)?,
    };
    let found = found.map_err(refuse)?;
    let text = match arguments.format {
        Format::Json => serde_json::to_string(&found).map_err(Exit::failure)? + "\n",
        Format::Csv => meshed.csv(&found),
    };
    write(&output, text)?;
    // The partial results are no longer needed.
    let _ = fs::remove_file(&partial);
    let (count, error) = (found.radiosity.len(), 100.0 * found.relative_l2_error);
    Ok(format!("{}: {count} patches, relative L2 error {error:.2e} %\n", output.display()))
}

/// The method for this number of patches, and the problem that it solves.
fn chosen(arguments: &Arguments, patches: usize) -> Result<(Method, Problem), Exit> {
    let smaller = if patches <= DENSE { MethodArgument::Dense } else { MethodArgument::Paths };
    let continuum = matches!(arguments.problem, ProblemArgument::Continuum);
    let dense = match arguments.method {
        None => smaller == MethodArgument::Dense && !continuum,
        Some(method) => method == MethodArgument::Dense,
    };
    if !dense {
        let paths_a_round = arguments.paths.div_ceil(u64::from(ROUNDS)) as u32;
        let problem = if continuum { Problem::Continuum } else { Problem::Patches };
        return Ok((
            Method::Paths { paths_a_round, rounds: ROUNDS, seed: arguments.seed },
            problem,
        ));
    }
    if continuum {
        return Err(Exit::bad_input("--problem continuum: the dense method solves patches only"));
    }
    if patches > MOST_DENSE {
        let message = format!("--method dense: {patches} patches; expected at most {MOST_DENSE}");
        return Err(Exit::bad_input(message));
    }
    Ok((Method::Dense { tolerance: arguments.tolerance }, Problem::Patches))
}

/// The file to write; makes the default folder.
fn output_file(arguments: &Arguments, scene: &str) -> Result<PathBuf, Exit> {
    if let Some(output) = &arguments.output {
        return Ok(output.clone());
    }
    let folder = Path::new("results/references");
    make_folder(folder, "references")?;
    let ending = match arguments.format {
        Format::Json => "json",
        Format::Csv => "csv",
    };
    Ok(folder.join(format!("{scene}.{ending}")))
}

impl Meshed {
    fn dense(&self, subject: Subject, tolerance: f64) -> Result<Reference, NoReference> {
        let steps = Steps::new("patches", self.patches.count());
        let (scene, patches) = (&self.space.scene, self.patches.clone());
        let dense = Dense::new(scene, patches, tolerance, self.threads, || steps.one());
        steps.end();
        Reference::new(subject, &self.patches, &dense.solve())
    }

    fn paths(
        &self,
        subject: Subject,
        saved: &Path,
    ) -> Result<Result<Reference, NoReference>, Exit> {
        let Method::Paths { paths_a_round, rounds, seed } = subject.method else {
            return Err(Exit::failure("not a method of paths"));
        };
        let Meshed { space, environment, patches, threads } = self;
        let paths = Paths::new(space, environment, patches, subject.problem, paths_a_round, seed);
        let mut partial = self.resumed(saved, subject);
        let steps = Steps::new("rounds", rounds as usize);
        steps.skip(partial.received.rounds);
        while partial.received.rounds < rounds {
            let first = partial.received.rounds;
            let next = (rounds - first).min(*threads as u32) as usize;
            let round = |i: usize| paths.round(first + i as u32);
            for received in parallel::map(next, *threads, steps.counting(round)) {
                partial.received.add(&received);
            }
            let text = serde_json::to_string(&partial).map_err(Exit::failure)?;
            write(saved, lab::sealed("", &text))?;
        }
        steps.end();
        let solution = paths.solution(&partial.received);
        Ok(Reference::new(partial.subject, patches, &solution))
    }

    /// The partial results of an interrupted computation of the same subject, or none.
    fn resumed(&self, saved: &Path, subject: Subject) -> Partial {
        let patches = self.patches.count();
        let text = fs::read_to_string(saved).unwrap_or_default();
        lab::unsealed("", &text)
            .and_then(|text| serde_json::from_str(text).ok())
            .filter(|old: &Partial| old.subject == subject && old.received.is_of(patches))
            .unwrap_or_else(|| Partial { subject, received: Received::new(patches) })
    }

    fn csv(&self, found: &Reference) -> String {
        let head =
            "patch,polygon,x_m,y_m,z_m,area_m2,red,green,blue,red_error,green_error,blue_error\n";
        let origin = self.space.scene.origin;
        let rows = self.environment.patches.iter().enumerate().map(|(i, patch)| {
            let [x, y, z] = (patch.centre + origin).to_array();
            let light = found.radiosity[i].iter().chain(&found.error[i]);
            let light: String = light.map(|number| format!(",{number}")).collect();
            format!("{i},{},{x},{y},{z},{}{light}\n", patch.polygon, patch.area)
        });
        rows.fold(head.to_owned(), |text, row| text + &row)
    }
}
