//! `virtwall run`: carries out an experiment and writes its results.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use config::{Dimension, parse, short_name};
use lab::{
    Claim, Endings, FileKind, HostClock, On, Options, Plan, Preparing, Results, ShotFiles, Traces,
    Viewing, check_writable, find_here, folder_for, obstacle,
};
use traces::{Format, Sample};

use crate::exit::{Exit, print, print_warnings};
use crate::files::make_folder;
use crate::live;
use crate::named::not_an_experiment;
use crate::progress::{Pilots, Progress};
use crate::provenance::provenance;
use crate::threads::Threads;

#[derive(Args)]
pub struct Arguments {
    /// Name of an experiment, or path to an experiment file. Scenes and machines are looked up in scenes/ and
    /// machines/ next to its folder, then in the current folder, then among those that are built in
    experiment: String,
    /// Folder for the results [default: results/<name of the experiment file>, followed by what --set and
    /// --network change]
    #[arg(short, long = "output", alias = "out", value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
    /// Override a value of the file, such as stop.patch_threshold="5 %" or processors=[1,2]; a list
    /// makes a sweep
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Network model: ideal, loggp, wormhole, flit, or auto for the cheapest that is accurate enough;
    /// short for --set machine.network.model=MODEL
    #[arg(long, value_name = "MODEL")]
    network: Option<String>,
    /// Where the parallel program runs
    #[arg(long, value_enum, default_value = "simulation")]
    on: OnArgument,
    /// Replace the results of another configuration that the folder holds
    #[arg(long)]
    replace: bool,
    /// Discard the finished runs of an interrupted sweep
    #[arg(long)]
    fresh: bool,
    /// Host memory for keeping shots between runs, such as 4GB or 500MiB [default: half of the free
    /// memory]
    #[arg(long, value_name = "SIZE", value_parser = size)]
    memory: Option<usize>,
    /// Keep shots in this folder, too, for this and later experiments. It can be emptied when no
    /// experiment is running
    #[arg(long, value_name = "DIR")]
    keep_shots: Option<PathBuf>,
    /// Write a trace of each run to this folder, in virtual time
    #[arg(long, value_name = "DIR")]
    trace: Option<PathBuf>,
    /// Format of the traces
    #[arg(long, value_enum, requires = "trace", default_value = "perfetto")]
    trace_format: FormatArgument,
    /// Show only one message in N in the traces; all computing is shown
    #[arg(long, value_name = "N", requires = "trace", default_value = "1")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    trace_sample: u32,
    /// Runs that the report's viewer shows: auto (all if there are few, else of each scene the runs on
    /// the fewest and the most processors), all, none, or rows of runs.csv such as 1,8,24
    #[arg(long, value_name = "RUNS", default_value = "auto", value_parser = viewing)]
    viewer: Viewing,
    #[command(flatten)]
    live: live::Serving,
    /// Write the events from which estimates of what is left are made to this file
    #[arg(long, value_name = "FILE", hide = true)]
    log_events: Option<PathBuf>,
    /// Print only errors: no warnings, no progress, no table
    #[arg(long, short)]
    quiet: bool,
}

fn viewing(text: &str) -> Result<Viewing, String> {
    let row = |row: &str| row.parse().ok().filter(|&row| row > 0);
    match text {
        "auto" => Ok(Viewing::Automatic),
        "all" => Ok(Viewing::All),
        "none" => Ok(Viewing::None),
        rows => {
            rows.split(',').map(row).collect::<Option<_>>().map(Viewing::Rows).ok_or_else(|| {
                "expected auto, all, none, or rows of runs.csv, counted from 1, such as 1,8"
                    .to_owned()
            })
        }
    }
}

fn size(text: &str) -> Result<usize, String> {
    parse(text, Dimension::Bytes).map(|bytes| bytes as usize)
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum OnArgument {
    /// On the simulated machine: virtual time, the same on every host
    Simulation,
    /// On threads of this host: the same light, no virtual time
    Threads,
}

#[derive(Clone, Copy, ValueEnum)]
enum FormatArgument {
    /// ui.perfetto.dev and trace_processor
    Perfetto,
    /// pj_dump and ViTE: text
    Paje,
}

/// Runs the experiment; returns the table of its results.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let (clock, provenance) = (HostClock::start(), provenance());
    let threads = arguments.threads.count();
    let memory = arguments.memory.unwrap_or_else(lab::half_of_free_memory);
    let network = network(arguments)?;
    let file = experiment_file(arguments)?;
    let changes = changes(arguments);
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let out = arguments.out.clone().unwrap_or_else(|| folder_for(&name, &changes));
    for folder in [out.join(".partial"), out.clone()] {
        check_writable(&folder).map_err(Exit::bad_input)?;
    }
    let set: Vec<String> = arguments.set.iter().cloned().chain(network).collect();
    let plan = Arc::new(read_plan(arguments, &file, &set, (threads, memory))?.changed(&changes));
    let on = match arguments.on {
        OnArgument::Simulation => On::Simulation,
        OnArgument::Threads => On::Threads,
    };
    check_before(arguments, &plan, on, &out)?;
    let traces = traces(arguments)?;
    let shot_files = arguments.keep_shots.as_deref().map(open_shot_files).transpose()?;
    let live = arguments.live.start(&plan)?;
    let claim = Claim::of(&out).map_err(Exit::bad_input)?;

    let viewing = arguments.viewer.clone();
    let log = arguments.log_events.as_deref().map(|path| event_log(path, &plan, threads));
    let log = log.transpose()?;
    let progress = Arc::new(Progress::new(Arc::clone(&plan), threads, arguments.quiet, log));
    let (fresh, counters) = (arguments.fresh, progress.shows_counters());
    let feed = live.as_ref().map(|live| live.feed());
    let options =
        Options { threads, fresh, on, memory, shot_files, traces, viewing, feed, counters };
    let watch = {
        let progress = Arc::clone(&progress);
        Arc::new(move |event| progress.update(event))
    };
    let endings = lab::carry_out(&plan, &out, &options, watch).map_err(Exit::failure)?;
    progress.end();

    let results = Results::of(&plan, &endings, &options).map_err(Exit::failure)?;
    lab::write_host_times(&out, &endings, clock.seconds(), threads, &provenance)
        .map_err(Exit::failure)?;
    lab::write_origin(&out, &file).map_err(Exit::failure)?;
    results.write(&out).map_err(Exit::failure)?;
    drop(claim);
    let mut output = output(&plan, &results, &endings);
    if let Some(trouble) = options.shot_files.and_then(|files| files.trouble()) {
        output += &format!("Shots could not be kept in {trouble}.\n");
    }
    output += &format!("Results are in {}.\n", out.display());
    if arguments.quiet {
        output.clear();
    } else {
        print_warnings(&lab::waste(&plan, &endings));
    }
    if let Some(live) = live {
        let printed = print(&std::mem::take(&mut output));
        live.finish(&out);
        printed?;
    }
    match results.failures() {
        0 => Ok(output),
        failures => {
            let message = format!("{failures} of {} runs failed", plan.runs.len());
            Err(Exit { code: 1, output, message })
        }
    }
}

/// The experiment file that the arguments mean.
fn experiment_file(arguments: &Arguments) -> Result<PathBuf, Exit> {
    let found = find_here(&FileKind::EXPERIMENTS, &arguments.experiment);
    found.map(|found| found.path).map_err(|message| meant(arguments, Exit::bad_input(message)))
}

/// How it failed; or the command that was meant, if the argument names a scene or a machine.
fn meant(arguments: &Arguments, exit: Exit) -> Exit {
    not_an_experiment(&arguments.experiment).map_or(exit, Exit::bad_input)
}

/// What `--set` and `--network` change, as in the name of the results.
fn changes(arguments: &Arguments) -> Vec<String> {
    let network = arguments.network.iter().map(|model| format!("network={model}"));
    arguments.set.iter().cloned().chain(network).collect()
}

/// Reads the experiment, searches the settings that it leaves open, and prints the warnings of its scenes.
fn read_plan(
    arguments: &Arguments,
    file: &Path,
    set: &[String],
    (threads, memory): (usize, usize),
) -> Result<Plan, Exit> {
    let pilots = Pilots::new(arguments.quiet);
    let on_pilot = |scene: &str, target, runs| pilots.update(scene, target, runs);
    let preparing = Preparing { threads, memory, finding: true, on_pilot: &on_pilot };
    let plan = Plan::read(file, set, &preparing).map_err(|fault| meant(arguments, fault.into()))?;
    pilots.end();
    if !arguments.quiet {
        print_warnings(&plan.warnings);
    }
    Ok(plan)
}

/// Checks, before anything is made, what could stop the runs or spoil what is in the folder of results.
fn check_before(arguments: &Arguments, plan: &Plan, on: On, out: &Path) -> Result<(), Exit> {
    arguments.viewer.check(plan).map_err(Exit::bad_input)?;
    let asked = [(arguments.trace.is_some(), "--trace"), (arguments.live.asked(), "--live")];
    if let Some((_, argument)) = asked.iter().find(|(asked, _)| *asked && on == On::Threads) {
        return Err(Exit::bad_input(needs_simulation(argument)));
    }
    if let Some(obstacle) = obstacle(plan, on, out).filter(|_| !arguments.replace) {
        let message = format!("{obstacle}, another folder by --output, or --replace");
        return Err(Exit::bad_input(message));
    }
    lab::check_targets(plan, out).map_err(Exit::bad_input)
}

/// The `--set` argument for which `--network` is short, if it is given.
fn network(arguments: &Arguments) -> Result<Option<String>, Exit> {
    const FIELD: &str = "machine.network.model";
    let Some(model) = &arguments.network else { return Ok(None) };
    let path = |set: &&String| set.split('=').next() == Some(FIELD);
    match arguments.set.iter().find(path) {
        Some(set) => Err(Exit::bad_input(format!(
            "--network {model}: found --set {set} too; expected one of the two"
        ))),
        None => Ok(Some(format!("{FIELD}={model}"))),
    }
}

fn output(plan: &Plan, results: &Results, endings: &Endings) -> String {
    let networks = lab::networks_text(plan, endings);
    let mut output = format!("{}\n{}\n{networks}", short_name(&plan.title), results.text());
    output.extend(plan.settings_found().iter().map(|found| format!("{found}\n")));
    output + &shots(endings)
}

fn needs_simulation(argument: &str) -> String {
    format!("{argument}: found --on threads; expected the simulation, which has virtual time")
}

/// Where and how to write traces, if the arguments ask for them; makes the folder.
fn traces(arguments: &Arguments) -> Result<Option<Traces>, Exit> {
    let Some(folder) = arguments.trace.clone() else { return Ok(None) };
    make_folder(&folder, "traces")?;
    check_writable(&folder).map_err(Exit::bad_input)?;
    let format = match arguments.trace_format {
        FormatArgument::Perfetto => Format::Perfetto,
        FormatArgument::Paje => Format::Paje,
    };
    Ok(Some(Traces { folder, format, sample: Sample::one_in(arguments.trace_sample) }))
}

fn open_shot_files(folder: &Path) -> Result<ShotFiles, Exit> {
    ShotFiles::open(folder).map_err(|error| {
        Exit::bad_input(format!("{}: cannot make a folder for shots: {error}", folder.display()))
    })
}

/// A new file of events that begins with what is known of a plan's runs.
fn event_log(path: &Path, plan: &Plan, threads: usize) -> Result<File, Exit> {
    let start = |mut file: File| {
        file.write_all(lab::event_log::head(plan, threads).as_bytes())?;
        Ok(file)
    };
    let made = File::create(path).and_then(start);
    made.map_err(|error| Exit::bad_input(format!("{}: {error}", path.display())))
}

/// A line with the numbers of shots found in memory, found on disk, and cast.
fn shots(endings: &Endings) -> String {
    let (shots, megabytes) = (endings.shots, endings.shot_bytes as f64 / 1e6);
    format!(
        "Shots: {} asked for, {} found in memory ({megabytes:.1} MB at most), {} on disk, {} cast.\n",
        shots.asked(),
        shots.in_memory,
        shots.archived,
        shots.cast,
    )
}
