//! Stability cases: failures of ray-based radiosity, each as a small experiment that can be run. Each
//! case has an expected result, which is compared with those of this program and of a naive method.

mod cases; // a case as its file states it: an experiment, changes to its scene, what is right
mod checks; // what is measured on the runs: rays, direct light, light
mod finding; // a measured quantity with its bound
mod naive; // naive methods, slow and used nowhere else
mod page; // the results as Markdown, CSV and SVG
mod runs; // the runs of a case
mod suite; // finds and runs cases

pub use cases::case_schema;
pub use finding::{Finding, Quantity};
pub use page::{csv, page, svg};
pub use suite::{CaseResult, cases, check, is_case, run_case};
