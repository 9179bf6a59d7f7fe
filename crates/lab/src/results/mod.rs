//! From finished runs to tables, plots and reports.
//!
//! - [`folder`]: The files of a folder of results.
//! - [`host_times`]: Columns of host times.
//! - [`run_table`]: The table of a plan's runs.
//! - [`networks`]: Network models compared.
//! - [`summary`]: Simulated figures compared with published ones.
//! - [`console`]: The table of results as text.
//! - [`series`]: The points and lines of a plot.
//! - [`pareto`]: The Pareto front of points.
//! - [`power_law`]: Power laws fitted to points.
//! - [`scale`]: The axes of a plot.
//! - [`chart`]: Plots as SVG.
//! - [`report`]: The report page.
//! - [`recordings`]: Recorded runs for the report.
//! - [`live_page`]: The page that follows runs.

pub mod chart;
pub mod console;
pub mod folder;
pub mod host_times;
pub mod live_page;
pub mod networks;
pub mod pareto;
pub mod power_law;
pub mod recordings;
pub mod report;
pub mod run_table;
pub mod scale;
pub mod series;
pub mod summary;
