//! Stability cases: failures of ray-based radiosity, each as a small experiment that can be run. Each
//! case has an expected result, which is compared with those of this program and of a naive method.
//!
//! - `cases`: a case as its file states it: an experiment, changes to its scene, what is right
//! - `runs`: the runs of a case
//! - `checks`: what is measured on the runs: rays, direct light, light
//! - `naive`: naive methods, slow and used nowhere else
//! - `finding`: a measured quantity with its bound
//! - `suite`: finds and runs cases
//! - `page`: the results as Markdown, CSV and SVG

mod cases;
mod checks;
mod finding;
mod naive;
mod page;
mod runs;
mod suite;

pub use cases::case_schema;
pub use finding::{Finding, Quantity};
pub use page::{csv, page, svg};
pub use suite::{CaseResult, cases, check, is_case, run_case};
