//! The table of results: its columns, and what is read from it.
//!
//! - [`column`]: A column of runs.csv, and what its cells are made of.
//! - [`columns`]: All columns of runs.csv.
//! - [`runs_csv`]: runs.csv in memory.
//! - [`measure`]: A column, or a product of columns.
//! - [`comparison`]: Published figures.
//! - [`cheapest`]: The cheapest run below an error.

pub mod cheapest;
pub mod column;
pub mod columns;
pub mod comparison;
pub mod measure;
pub mod runs_csv;
