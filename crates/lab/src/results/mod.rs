//! From finished runs to tables, plots and reports.

pub mod axes; // The axes of a panel of a plot.
pub mod canvas; // The surface of a plot: an SVG file.
pub mod chart; // Plots, from title to key.
pub mod configuration; // Which configuration results are of.
pub mod console; // The table of results as text.
pub mod empty; // Why a plot shows nothing.
pub mod folder; // The files of a folder of results.
pub mod host_times; // Columns of host times.
pub mod label_places; // Where labels of lines are.
pub mod layout; // Where the parts of a plot are.
pub mod live_page; // The page that follows runs.
pub mod marks; // The points and lines of a panel.
pub mod networks; // Network models compared.
pub mod operations; // The operations of runs, a row each.
pub mod origin; // The experiment file that results were made from.
pub mod pareto; // The Pareto front of points.
pub mod power_law; // Power laws fitted to points.
pub mod present; // The plots that an experiment file asks for now.
pub mod recordings; // Recorded runs for the report.
pub mod repeats; // Mean and spread of repeats.
pub mod repeats_csv; // summary.csv.
pub mod report; // The report page.
pub mod run_table; // The table of a plan's runs.
pub mod scale; // The axes of a plot.
pub mod series; // The points and lines of a plot.
pub mod strokes; // Dashes of lines, and turns of those that coincide.
pub mod style; // Colour, marker and dash of each line.
pub mod summary; // Simulated figures compared with published ones.
pub mod waste; // Warnings of runs that made many more shots than one processor.
pub mod without_time; // Results without virtual time.
