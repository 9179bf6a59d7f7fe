//! The results of all cases as files.

mod csv; // the table, a line for each finding
mod markdown; // the page
mod svg; // the drawing

pub use csv::csv;
pub use markdown::page;
pub use svg::svg;
