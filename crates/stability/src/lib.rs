//! Where radiosity by rays fails: each failure a case that can be run, with what right means, what a
//! naive method does, and what ours does.
//!
//! A [`Case`] is a file: an experiment, changes to its scene, and what is right. [`try_case`] finds out.
//! The naive methods are slow twins that live here and nowhere else.

mod bench;
mod case;
mod change;
mod direct;
mod light;
mod naive;
mod page;
mod rays;
mod right;
mod suite;

pub use case::{Case, Listed, Overlay, case_schema};
pub use change::{Change, Turn};
pub use naive::Twin;
pub use page::{csv, page, svg};
pub use right::{Exact, Finding, Right, Said};
pub use suite::{Verdict, cases, check, is_case, try_case};
