//! The results of all cases as files.
//!
//! - `markdown`: the page
//! - `csv`: the table, a line for each finding
//! - `svg`: the drawing

mod csv;
mod markdown;
mod svg;

pub use csv::csv;
pub use markdown::page;
pub use svg::svg;
