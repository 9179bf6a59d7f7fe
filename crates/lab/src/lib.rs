//! Experiment files, their sweeps, results, tables, plots and reports.
//!
//! A file is read, expanded and validated once, at the door ([`Plan::read`]); the plan is carried
//! out, run by run, each saved as it ends ([`carry_out`]); its results are written whole
//! ([`Results`]). Knows nothing of how a kernel or a link works: all of that is behind `engine`.

mod accuracy;
mod answer;
mod causes;
mod chart;
mod cheapest;
mod check;
mod columns;
mod comparison;
mod console;
mod cut;
mod digest;
mod display;
mod document;
mod engine;
mod error_causes;
mod errors;
mod experiment;
mod family;
mod fault;
mod feed;
mod figures;
mod file;
mod find;
mod held;
mod hemisphere;
mod host_clock;
mod host_memory;
mod host_times;
mod interfaces;
mod json;
mod knobs;
mod live_page;
mod machine_file;
mod measure;
mod medium;
mod message_layer;
mod network;
mod networks;
mod node_memory;
mod open_machine;
mod open_scene;
mod pareto;
mod pilot;
mod place;
mod plan;
mod planner;
mod plots;
mod power_law;
mod preparing;
mod problem;
mod program;
mod pulse;
mod quantity;
mod queue;
mod ray_bench;
mod reels;
mod refine;
mod report;
mod results;
mod runner;
mod saved;
mod scale;
mod scene;
mod scene_file;
mod schema;
mod series;
mod settings;
mod shot_files;
mod source_split;
mod stage;
mod start_up;
mod suits;
mod summary;
mod sweep;
mod table;
mod traces;
mod trials;
mod tuned;
mod tuner;
mod viewing;
mod wall_mesh;

pub use check::check;
pub use document::Document;
pub use engine::{Light, On};
pub use experiment::{Plot, experiment_schema};
pub use fault::Fault;
pub use feed::{Feed, News};
pub use file::{read_text, write as write_file};
pub use host_clock::HostClock;
pub use host_memory::half_of_free_memory;
pub use live_page::live_page;
pub use networks::text as networks_text;
pub use open_machine::OpenMachine;
pub use open_scene::OpenScene;
pub use place::Place;
pub use plan::Plan;
pub use preparing::Preparing;
pub use pulse::Pulse;
pub use ray_bench::RayBench;
pub use results::{Results, write_host_times};
pub use runner::{Endings, Event, Options, Watch, carry_out};
pub use scene_file::scene_schema;
pub use shot_files::ShotFiles;
pub use stage::{Stage, StagedRun, Which};
pub use table::Table;
pub use traces::Traces;
pub use trials::Trials;
pub use viewer::LivePage;
pub use viewing::Viewing;

/// Draws a plot of a table as the text of an SVG file; a column `paper_<y>` or
/// `published_<y>` holds published points.
pub fn svg(table: &Table, plot: &Plot) -> String {
    chart::svg(table, &[], plot)
}
