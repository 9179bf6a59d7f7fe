//! Experiment files, their sweeps, results, tables, plots and reports.
//!
//! A file is read, expanded and validated once, at the door ([`Plan::read`]); the plan is carried
//! out, run by run, each saved as it ends ([`carry_out`]); its results are written whole
//! ([`Results`]). Knows nothing of how a kernel or a link works: all of that is behind `engine`.

mod chart;
mod check;
mod columns;
mod comparison;
mod console;
mod cut;
mod digest;
mod document;
mod engine;
mod experiment;
mod fault;
mod figures;
mod find;
mod host_clock;
mod json;
mod name;
mod open_scene;
mod output;
mod place;
mod plan;
mod planner;
mod problem;
mod quantity;
mod queue;
mod report;
mod results;
mod runner;
mod saved;
mod scale;
mod scene_file;
mod schema;
mod series;
mod summary;
mod sweep;
mod table;

pub use check::check;
pub use fault::Fault;
pub use host_clock::HostClock;
pub use open_scene::OpenScene;
pub use output::write as write_file;
pub use plan::Plan;
pub use results::{Results, write_host_times};
pub use runner::{Endings, Event, On, Options, Watch, carry_out};
pub use schema::{experiment_schema, scene_schema};
