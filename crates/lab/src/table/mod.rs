//! The table of results: its columns, and what is read from it.

pub mod axis_title; // Titles of axes, with units.
pub mod cheapest; // The cheapest run below an error.
pub mod column; // A column of runs.csv, and what its cells are made of.
pub mod columns; // All columns of runs.csv, and what each is.
pub mod comparison; // Published figures.
pub mod every_run; // The columns that every runs.csv has.
pub mod features; // The columns of what only some runs use.
pub mod measure; // A column, or a product of columns.
pub mod runs_csv; // runs.csv in memory.
