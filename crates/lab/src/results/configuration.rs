//! Which configuration the results in a folder are of. A folder of results belongs to one.

use std::io;
use std::path::{Path, PathBuf};

use config::{Document, short_name};
use serde_json::{Map, Value};

use crate::engine::simulator::On;
use crate::files::digest::sha256;
use crate::files::file;
use crate::planning::plan::Plan;
use crate::results::folder::figures_of;
use crate::results::{host_times, operations, origin};

/// Fields of an experiment that decide no figure.
const PRESENTATION: [&str; 3] = ["$schema", "title", "plots"];

/// The longest name of a folder that is made from arguments.
const LONGEST: usize = 100;

/// The folder for the results of an experiment with these `path=value` arguments, in `results`: each
/// configuration has one of its own.
pub fn folder_for(name: &str, arguments: &[String]) -> PathBuf {
    let plain = |c: &char| c.is_alphanumeric() || "-_.,=".contains(*c);
    let change = |argument: &String| -> String { argument.chars().filter(plain).collect() };
    let mut folder = name.to_owned();
    arguments.iter().for_each(|argument| folder += &format!("+{}", change(argument)));
    if folder.chars().count() > LONGEST {
        let digest = &sha256(arguments.join("\n").as_bytes())[..8];
        folder = folder.chars().take(LONGEST).collect::<String>() + "-" + digest;
    }
    Path::new("results").join(folder)
}

/// The manifest of a folder of results.
const MANIFEST: &str = "manifest.json";

/// Checks that no result of a plan would replace a device, a named pipe or a folder.
///
/// # Errors
/// Those of [`file::target`].
pub fn check_targets(plan: &Plan, out: &Path) -> io::Result<()> {
    let others = [MANIFEST, host_times::FILE, origin::FILE].map(str::to_owned);
    let mut names = drawn(plan).chain(others);
    names.try_for_each(|name| file::target(&out.join(name)).map(drop))
}

/// What stands against the results of a plan in a folder, and what is expected there: files that no run wrote,
/// or results of another configuration.
pub fn obstacle(plan: &Plan, on: On, out: &Path) -> Option<String> {
    let path = out.join(MANIFEST);
    let place = path.display();
    if !path.exists() {
        let foreign = drawn(plan).map(|name| out.join(name)).find(|path| path.exists())?;
        let foreign = foreign.display();
        return Some(format!(
            "{foreign}: not from a run: no {MANIFEST} beside it; expected results that `run` wrote"
        ));
    }
    match Document::read(&path) {
        Err(fault) => Some(format!("{fault}; expected a manifest that `run` wrote")),
        Ok(document) if !document.value["experiment"].is_object() => {
            Some(format!("{place}: no \"experiment\"; expected a manifest that `run` wrote"))
        }
        Ok(document) => difference(plan, on, &document.value).map(|difference| {
            let out = out.display();
            format!("{out}: has results of another configuration: {difference}; expected the same")
        }),
    }
}

/// Names of the files with the figures of a plan's results: tables, drawings and report.
fn drawn(plan: &Plan) -> impl Iterator<Item = String> {
    let tables = ["runs.csv", operations::FILE, "report.html"].map(str::to_owned);
    tables.into_iter().chain(figures_of(&plan.plots))
}

/// How results with this manifest differ from those of a plan: the first value of their configurations that does,
/// in words. None if they are of the same configuration.
fn difference(plan: &Plan, on: On, there: &Value) -> Option<String> {
    let files = plan.files.iter().map(|file| (file.label.clone(), file.sha256.clone().into()));
    let files: Map<String, Value> = files.collect();
    difference_of_experiments(&plan.resolved, &there["experiment"])
        .or_else(|| named("on", &serde_json::json!(on), &there["on"]))
        .or_else(|| named("SHA-256 of file ", &Value::Object(files), &there["files"]))
}

/// The first difference of two experiments with all defaults, besides what only presents results, in words.
pub fn difference_of_experiments(here: &Value, there: &Value) -> Option<String> {
    let without = |experiment: &Value| {
        let mut experiment = experiment.clone();
        let fields = experiment.as_object_mut();
        fields
            .into_iter()
            .for_each(|fields| fields.retain(|key, _| !PRESENTATION.contains(&key.as_str())));
        experiment
    };
    named("", &without(here), &without(there))
}

fn named(place: &str, here: &Value, there: &Value) -> Option<String> {
    first_difference(place, here, there)
        .map(|(place, here, there)| format!("{place} is {there} there and {here} here"))
}

/// The place of the first difference of two values, and both values there.
fn first_difference(place: &str, here: &Value, there: &Value) -> Option<(String, String, String)> {
    if let (Value::Object(one), Value::Object(other)) = (here, there) {
        let keys = one.keys().chain(other.keys().filter(|key| !one.contains_key(*key)));
        return keys.into_iter().find_map(|key| {
            let joint = if place.is_empty() || place.ends_with(' ') { "" } else { "." };
            first_difference(&format!("{place}{joint}{key}"), &here[key], &there[key])
        });
    }
    let shown = |value: &Value| match value {
        Value::Null => "not given".to_owned(),
        value => short_name(&value.to_string()),
    };
    (here != there).then(|| (place.to_owned(), shown(here), shown(there)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_in_the_name_of_the_folder() {
        let folder = |arguments: &[&str]| {
            let arguments: Vec<String> = arguments.iter().map(|&a| a.to_owned()).collect();
            folder_for("x", &arguments).to_string_lossy().into_owned()
        };
        assert_eq!(folder(&[]), "results/x");
        assert_eq!(folder(&["network=auto"]), "results/x+network=auto");
        assert_eq!(folder(&["a=[1, 2]", "b=\"5 %\""]), "results/x+a=1,2+b=5");
        assert_eq!(folder(&["scene=../a/b.json"]), "results/x+scene=..ab.json");
        let long = folder(&[&"y".repeat(300)]);
        assert!(long.len() < 130 && long != folder(&[&"y".repeat(301)]), "{long}");
    }

    #[test]
    fn the_first_difference_is_named_with_both_values() {
        let value = |text: &str| serde_json::from_str::<Value>(text).unwrap();
        let here = value(r#"{ "a": 1, "b": { "c": [1, 2] } }"#);
        assert_eq!(first_difference("", &here, &here.clone()), None);
        let there = value(r#"{ "a": 1, "b": { "c": [1], "d": 3 } }"#);
        let expected = ("b.c".to_owned(), "[1,2]".to_owned(), "[1]".to_owned());
        assert_eq!(first_difference("", &here, &there), Some(expected));
        let there = value(r#"{ "a": 1 }"#);
        assert_eq!(first_difference("", &here, &there).unwrap().2, "not given");
    }
}
