//! Where radiosity by rays fails: each failure a case that can be run, with what right means, what a
//! naive method does, and what ours does.
//!
//! A [`Case`] is a file: an experiment, changes to its scene, and what is right. [`try_case`] finds out.
//! The naive methods are slow twins that live here and nowhere else.

mod bench;
mod case;
mod change;
mod direct;
mod finding;
mod light;
mod measures;
mod naive;
mod page;
mod rays;
mod right;
mod suite;
mod twin;

pub use case::{Case, Listed, Overlay, case_schema};
pub use change::{Change, Turn};
pub use finding::{Finding, Said};
pub use page::{csv, page, svg};
pub use right::{Exact, Right};
pub use suite::{Verdict, cases, check, is_case, try_case};
pub use twin::Twin;
