//! Experiment files, their sweeps, results, tables, plots and reports.
//!
//! An experiment file is read, expanded and validated once ([`Plan::read`]); the plan's runs are carried
//! out, each saved as it ends ([`carry_out`]); the results are written whole ([`Results`]).

mod accuracy; // errors of runs, and the search for settings that reach an error
mod engine; // one run; only this folder calls the simulator
mod experiment; // an experiment file: its fields, and the product of its lists
mod files; // reading of files: names, JSON, units, digests, and messages about what is wrong
mod glossary; // what columns, fields, choices and network models mean
mod host; // the computer that this program runs on: clock, memory, locks, the program file
mod inspect; // single files, scenes and runs, without a folder of results
mod open; // scenes and machines: from their files to meshed and cut problems
mod planning; // from an experiment file to all its runs, every check included
mod results; // from finished runs to tables, plots and reports
mod run; // carries out the runs of a plan on worker threads
mod table; // the table of results: its columns, and what is read from it

pub use engine::simulator::{Light, On, Solved};
pub use experiment::plot::Plot;
pub use experiment::schema::experiment_schema;
pub use files::digest::{sealed, unsealed};
pub use files::file::{check_writable, target, write as write_file};
pub use files::find::{FileKind, Found, all_here, find_here};
pub use glossary::entries::{explain, glossary};
pub use glossary::entry::{Entry, Term};
pub use host::host_clock::HostClock;
pub use host::host_memory::half_of_free_memory;
pub use inspect::check::{Checked, check};
pub use inspect::kind::Kind;
pub use inspect::outline::Outline;
pub use inspect::stage::{Stage, StagedRun, Which};
pub use inspect::trials::Trials;
pub use open::first_light::FirstLight;
pub use open::flip::{Flipped, flip};
pub use open::lighting::percent;
pub use open::machine_file::MachineFile;
pub use open::open_scene::OpenScene;
pub use open::ray_bench::RayBench;
pub use open::scene_file::scene_schema;
pub use planning::plan::Plan;
pub use planning::preparing::Preparing;
pub use results::configuration::{check_targets, folder_for, obstacle};
pub use results::folder::{Results, write_host_times};
pub use results::live_page::live_page;
pub use results::networks::text as networks_text;
pub use results::origin::write_origin;
pub use results::waste::waste;
pub use run::claim::Claim;
pub use run::estimate::{Estimator, Known, Left};
pub use run::event_log;
pub use run::feed::{Feed, News};
pub use run::progress::Counters;
pub use run::runner::{Endings, Event, Options, Watch, carry_out};
pub use run::shot_files::ShotFiles;
pub use run::shot_sum::Done;
pub use run::traces::Traces;
pub use run::viewing::Viewing;
pub use table::columns::runs_schema;
pub use table::runs_csv::Table;
pub use viewer::LivePage;

/// Draws a plot of a table as the text of an SVG file; a column `paper_<y>` or
/// `published_<y>` holds published points.
pub fn svg(table: &Table, plot: &Plot) -> String {
    results::chart::svg(table, &[], plot, 1)
}
