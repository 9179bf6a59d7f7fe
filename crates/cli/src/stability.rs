//! `virtwall stability`: runs cases in which radiosity by rays can fail, and writes the page of results.

use std::path::{Path, PathBuf};

use clap::Args;
use stability::{CaseResult, cases, csv, page, run_case, svg};

use crate::exit::Exit;
use crate::files::{make_folder, write};
use crate::steps::Steps;

#[derive(Args)]
pub struct Arguments {
    /// Case files, or names of cases in the folder of cases [default: all cases]
    case: Vec<String>,
    /// Folder of the cases [default: experiments/stability, or the built-in cases if there is no such folder]
    #[arg(long, value_name = "DIR")]
    cases: Option<PathBuf>,
    /// Folder for the page, its table and its drawing [default: results/stability if all cases run,
    /// else none]
    #[arg(short, long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Runs the cases; returns a line of CSV for each.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let folder = arguments.cases.clone().unwrap_or_else(default_folder);
    let paths = match arguments.case.is_empty() {
        true => cases(&folder)?,
        false => {
            (arguments.case.iter().map(|name| place(&folder, name))).collect::<Result<_, Exit>>()?
        }
    };
    let all = || arguments.case.is_empty().then(|| PathBuf::from("results/stability"));
    let out = arguments.out.clone().or_else(all);
    out.iter().try_for_each(|out| lab::check_writable(out)).map_err(Exit::bad_input)?;
    let steps = Steps::new("cases", paths.len());
    let try_one = |number: usize| run_case(&paths[number]);
    let tried = parallel::map(paths.len(), parallel::host_threads(), steps.counting(try_one));
    steps.end();
    let results = tried.into_iter().collect::<Result<Vec<_>, _>>()?;
    let output = csv(&results).map_err(Exit::failure)?;
    if let Some(out) = out {
        write_page(&out, &results, &output)?;
    }
    match results.iter().filter(|result| !result.holds()).count() {
        0 => Ok(output),
        wrong => {
            let message = format!("{wrong} of {} cases failed", results.len());
            Err(Exit { code: 1, output, message })
        }
    }
}

fn default_folder() -> PathBuf {
    let folder = Path::new("experiments/stability");
    if folder.is_dir() { folder.to_owned() } else { Path::new(shipped::ROOT).join(folder) }
}

/// A case's file, given its path or its name in the folder of cases.
fn place(folder: &Path, name: &str) -> Result<PathBuf, Exit> {
    let path = PathBuf::from(name);
    let in_folder = folder.join(format!("{name}.json"));
    if let Some(found) = [path, in_folder].into_iter().find(|path| shipped::is_file(path)) {
        return Ok(found);
    }
    if Path::new(name).exists() && !Path::new(name).is_dir() {
        return Err(Exit::bad_input(format!("{name}: not a regular file")));
    }
    let names = cases(folder)?;
    let names: Vec<&str> = names.iter().filter_map(|path| path.file_stem()?.to_str()).collect();
    Err(Exit::bad_input(format!("unknown case \"{name}\" (there are: {})", names.join(", "))))
}

fn write_page(out: &Path, results: &[CaseResult], table: &str) -> Result<(), Exit> {
    make_folder(out, "results")?;
    write(&out.join("README.md"), page(results))?;
    write(&out.join("cases.csv"), table)?;
    write(&out.join("stability.svg"), svg(results))
}
