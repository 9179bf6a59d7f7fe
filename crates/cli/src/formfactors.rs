//! `virtwall formfactors`: computes form factors between the objects of a scene.

use std::io;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use config::short_name;
use lab::{OpenScene, Table};
use radiosity::{Scene, Space};
use reference::{Estimate, ObjectRays, Objects};
use serde_json::json;

use crate::exit::{Exit, print_warnings};
use crate::files::{check_writable, write};
use crate::steps::Steps;
use crate::threads::Threads;

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, or path to a scene description (.json) or an OBJ file; an object is the union
    /// of its faces
    scene: String,
    /// Method
    #[arg(long, value_enum, default_value = "exact")]
    method: Method,
    /// Error tolerance of exact form factors; error estimates show where it was missed
    #[arg(long, value_name = "ERROR", default_value = "1e-6", value_parser = tolerance)]
    tolerance: f64,
    /// Approximate number of rays from each object
    #[arg(long, value_name = "N", default_value_t = 1 << 20, value_parser = clap::value_parser!(u64).range(1..=1 << 40))]
    rays: u64,
    /// Seed of the rays' starting points
    #[arg(long, value_name = "N", default_value_t = 1996)]
    seed: u64,
    /// Between objects, or between their faces
    #[arg(long, value_enum, default_value = "objects")]
    between: Between,
    /// Leave out form factors that are smaller
    #[arg(long, value_name = "F", value_parser = least)]
    least: Option<f64>,
    /// Close each row: add the sum of what was left out, "(less)", and what is missing from 1, "(sky)": it leaves
    /// the scene or ends on the back of a face
    #[arg(long)]
    sums: bool,
    /// Output format
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
    /// Write to this file instead of printing
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
}

#[derive(Clone, Copy, ValueEnum)]
enum Method {
    /// The kernel's rays from points all over each object; the error is a standard error
    Rays,
    /// Adaptive quadrature of Lambert's contour integral with exact shadows; the error is in practice
    /// a bound
    Exact,
}

#[derive(Clone, Copy, ValueEnum)]
enum Between {
    Objects,
    Faces,
}

impl Between {
    fn of(self, scene: &Scene) -> Objects<'_> {
        match self {
            Between::Objects => Objects::new(scene),
            Between::Faces => Objects::faces_of(scene),
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Csv,
    Json,
    Text,
}

/// Parses a tolerance that arithmetic can reach.
pub fn tolerance(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| (1e-12..=0.1).contains(value));
    value.ok_or_else(|| "expected a number from 1e-12 to 0.1".to_owned())
}

fn least(text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| (0.0..=1.0).contains(value));
    value.ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// Computes form factors; returns what to print.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    arguments.output.iter().try_for_each(|path| check_writable(path))?;
    let open = OpenScene::load(&arguments.scene)?.without_media()?;
    print_warnings(&open.warnings);
    let objects = arguments.between.of(&open.scene);
    let threads = arguments.threads.count();
    let matrix = match arguments.method {
        Method::Exact => exact(&objects, arguments.tolerance, threads),
        Method::Rays => by_rays(&open, arguments, threads)?,
    };
    let all = matrix.iter().flatten();
    if all.clone().any(|found| !(found.value.is_finite() && found.error.is_finite())) {
        return Err(Exit::failure("a form factor that is not finite; nothing is written"));
    }
    let text = formatted(&objects, &matrix, arguments).map_err(Exit::failure)?;
    let Some(path) = &arguments.output else { return Ok(text) };
    write(path, text)?;
    Ok(String::new())
}

/// Form factors, row by row.
type Matrix = Vec<Vec<Estimate>>;

fn exact(objects: &Objects, tolerance: f64, threads: usize) -> Matrix {
    let count = objects.count();
    let pairs: Vec<_> = (0..count).flat_map(|i| (i..count).map(move |j| (i, j))).collect();
    let steps = Steps::new("pairs of objects", pairs.len());
    let work = |pair: usize| {
        let (from, to) = pairs[pair];
        objects.exact(from, to, tolerance)
    };
    let found = parallel::map(pairs.len(), threads, steps.counting(work));
    steps.end();
    let mut matrix = vec![vec![Estimate::default(); count]; count];
    for ((i, j), [there, back]) in pairs.into_iter().zip(found) {
        matrix[j][i] = back;
        matrix[i][j] = there;
    }
    matrix
}

fn by_rays(open: &OpenScene, arguments: &Arguments, threads: usize) -> Result<Matrix, Exit> {
    let space = Space::new(open.scene.clone(), open.cells);
    let objects = arguments.between.of(&space.scene);
    let rays = ObjectRays::new(&objects, &space, arguments.rays, arguments.seed)
        .map_err(Exit::bad_input)?;
    let steps = Steps::new("objects", objects.count());
    let matrix = parallel::map(objects.count(), threads, steps.counting(|from| rays.from(from)));
    steps.end();
    Ok(matrix)
}

/// What is printed of an object's row: names and form factors.
fn row<'a>(
    objects: &'a Objects,
    all: &[Estimate],
    arguments: &Arguments,
) -> Vec<(&'a str, Estimate)> {
    let named = all.iter().enumerate().map(|(to, &found)| (objects.name(to), found));
    let (mut row, less): (Vec<_>, Vec<_>) =
        named.partition(|(_, found)| arguments.least.is_none_or(|least| found.value >= least));
    if arguments.sums {
        let less = sum(less.iter().map(|(_, found)| found));
        let Estimate { value, error } = sum(all);
        row.extend([("(less)", less), ("(sky)", Estimate { value: 1.0 - value, error })]);
    }
    row
}

/// A sum of form factors; the error is at most the sum of the errors.
fn sum<'a>(all: impl IntoIterator<Item = &'a Estimate>) -> Estimate {
    let add = |sum: Estimate, one: &Estimate| Estimate {
        value: sum.value + one.value,
        error: sum.error + one.error,
    };
    all.into_iter().fold(Estimate::default(), add)
}

fn formatted(objects: &Objects, matrix: &Matrix, arguments: &Arguments) -> io::Result<String> {
    let count = objects.count();
    let rows = (0..count).flat_map(|from| {
        let row = row(objects, &matrix[from], arguments);
        row.into_iter().map(move |(to, found)| (objects.name(from), to, found))
    });
    Ok(match arguments.format {
        Format::Csv => {
            let columns = ["from", "to", "form_factor", "error_estimate"].map(str::to_owned);
            let rows = rows.map(|(from, to, Estimate { value, error })| {
                vec![from.to_owned(), to.to_owned(), value.to_string(), format!("{error:.2e}")]
            });
            let table = Table { columns: columns.to_vec(), rows: rows.collect() };
            String::from_utf8_lossy(&table.to_csv()?).into_owned()
        }
        Format::Json => {
            let rows = rows.map(|(from, to, Estimate { value, error })| {
                json!({ "from": from, "to": to, "form_factor": value, "error_estimate": error })
            });
            let area =
                |object| json!({ "name": objects.name(object), "area_m2": objects.area(object) });
            let areas = (0..count).map(area).collect::<Vec<_>>();
            let rows = rows.collect::<Vec<_>>();
            format!("{:#}\n", json!({ "objects": areas, "form_factors": rows }))
        }
        Format::Text => {
            let widest =
                (0..count).map(|object| short_name(objects.name(object)).chars().count()).max();
            let width = widest.unwrap_or(0).max(6) + 2;
            let head = format!("{:width$}{:width$}form factor   error estimate\n", "from", "to");
            rows.fold(head, |text, (from, to, Estimate { value, error })| {
                let [from, to] = [from, to].map(short_name);
                text + &format!("{from:width$}{to:width$}{value:<12.10}  {error:.1e}\n")
            })
        }
    })
}
