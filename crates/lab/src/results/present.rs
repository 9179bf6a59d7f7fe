//! The plots that an experiment file asks for now, for results that were made from it earlier.

use std::path::{Component, Path, PathBuf};

use config::{Document, Fault};
use serde_json::Value;

use crate::experiment::plot::Plot;
use crate::planning::plots::check_plots;
use crate::planning::reading::read_alone;
use crate::results::configuration::difference_of_experiments;
use crate::results::folder::Results;
use crate::results::origin::origin;
use crate::table::columns;

impl Results {
    /// Takes the plots that the experiment file of the results in a folder asks for now, if that file still is of the
    /// same configuration. Says which plots they are.
    ///
    /// # Errors
    /// If the file asks for plots that the results do not have the columns of.
    pub fn take_present_plots(&mut self, folder: &Path) -> Result<String, Fault> {
        match self.present(folder)? {
            Ok((plots, file)) => {
                self.manifest["experiment"]["plots"] = plots;
                Ok(format!("Plots are those of {file}."))
            }
            Err(why) => Ok(format!("Plots are those of manifest.json: {why}.")),
        }
    }

    /// The plots, and their file's name; or why they are not to be taken.
    fn present(&self, folder: &Path) -> Result<Result<(Value, String), String>, Fault> {
        let Some(path) = origin(folder).map(|path| shortest(&path)) else {
            return Ok(Err("the folder does not say which experiment file it is from".to_owned()));
        };
        let file = path.display().to_string();
        let (document, experiment) = match Document::read(&path).and_then(read_alone) {
            Ok(read) => read,
            Err(fault) => return Ok(Err(fault.to_string())),
        };
        if let Some(difference) =
            difference_of_experiments(&self.manifest["experiment"], &experiment)
        {
            return Ok(Err(format!("{file} is of another configuration now: {difference}")));
        }
        let plots = &experiment["plots"];
        // Just read as an experiment.
        let typed: Vec<Plot> = serde_json::from_value(plots.clone()).unwrap_or_default();
        let known = columns::drawable(self.table.columns.clone());
        check_plots(&typed, &known, &self.sweeps(), &document)?;
        Ok(Ok((plots.clone(), file)))
    }
}

/// A path without what leads into folders and out again.
fn shortest(path: &Path) -> PathBuf {
    let mut short = PathBuf::new();
    for part in path.components() {
        let inside = matches!(short.components().next_back(), Some(Component::Normal(_)));
        if part == Component::ParentDir && inside {
            short.pop();
        } else {
            short.push(part);
        }
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_short() {
        for (long, short) in [
            ("results/x/../../experiments/x.json", "experiments/x.json"),
            ("../a/../../b", "../../b"),
            ("/a/./b", "/a/b"),
        ] {
            assert_eq!(shortest(Path::new(long)), Path::new(short));
        }
    }
}
