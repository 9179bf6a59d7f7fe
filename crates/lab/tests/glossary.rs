//! Everything that has a name is explained, and axes of plots have units.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use lab::{Entry, Plot, Table, Term, explain, glossary};
use serde_json::Value;

/// All units of columns, and what stands for one.
const UNITS: [&str; 7] = ["s", "B", "%", "ratio", "count", "number", "text"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The JSON files of a folder.
fn files(folder: &str) -> Vec<Value> {
    let entries = fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let json = entries.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    json.map(|path| serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()).collect()
}

fn fact<'a>(entry: &'a Entry, name: &str) -> Option<&'a str> {
    entry.facts.iter().find(|(fact, _)| *fact == name).map(|(_, value)| value.as_str())
}

#[test]
fn every_name_has_an_explanation() {
    for entry in glossary() {
        assert!(!entry.about.is_empty() && entry.about.ends_with(['.', ':']), "{entry:?}");
        assert!(explain(&entry.name).unwrap().contains(&entry), "{entry:?}");
        if entry.term == Term::Column {
            assert!(UNITS.contains(&fact(&entry, "unit").unwrap()), "{entry:?}");
        }
    }
}

#[test]
fn every_column_of_committed_results_is_explained() {
    for folder in fs::read_dir(root().join("results")).unwrap() {
        let Ok(csv) = fs::read(folder.unwrap().path().join("runs.csv")) else { continue };
        for column in Table::from_csv(&csv).unwrap().columns {
            assert!(explain(&column).is_ok(), "{column}");
        }
    }
}

/// The paths of all fields under a value.
fn paths(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            let parts = ["value", "provenance", "source"];
            for (name, field) in fields {
                let inner = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                // A number with its provenance is one field; a mark names columns.
                if !(fields.len() == 3 && parts.contains(&name.as_str())) && path != "plots.mark" {
                    found.insert(inner.clone());
                    paths(field, &inner, found);
                }
            }
        }
        Value::Array(items) => items.iter().for_each(|item| paths(item, path, found)),
        _ => {}
    }
}

#[test]
fn every_field_of_shipped_files_is_explained() {
    let kinds = [
        ("experiments", Term::ExperimentField),
        ("machines", Term::MachineField),
        ("scenes", Term::SceneField),
    ];
    for (folder, term) in kinds {
        let mut fields = BTreeSet::new();
        files(folder).iter().for_each(|file| paths(file, "", &mut fields));
        assert!(fields.len() > 10, "{folder}");
        for field in fields {
            let of_machine = field.starts_with("machine.").then_some(Term::MachineField);
            let terms: Vec<Term> = explain(&field)
                .unwrap_or_else(|near| panic!("{folder}: {field}, near {near:?}"))
                .iter()
                .map(|entry| entry.term)
                .collect();
            assert!(terms.contains(&of_machine.unwrap_or(term)), "{folder}: {field}");
        }
    }
}

#[test]
fn every_choice_that_a_field_marks_is_explained_with_that_field() {
    let marked = |entry: &Entry| -> Vec<String> {
        let marks = entry.about.split("Choice C").skip(1);
        let number = |rest: &str| rest.chars().take_while(char::is_ascii_digit).collect::<String>();
        marks.map(|rest| format!("C{}", number(rest))).collect()
    };
    let mut seen = BTreeSet::new();
    for entry in glossary().iter().filter(|entry| entry.term == Term::ExperimentField) {
        for choice in marked(entry) {
            let found = explain(&choice).unwrap();
            let fields = fact(&found[0], "field").unwrap();
            let first = entry.name.split('.').next().unwrap();
            assert!(fields.contains(first), "{choice}: {fields}; {}", entry.name);
            seen.insert(choice);
        }
    }
    assert!(seen.len() > 10, "{seen:?}");
}

/// A cell of a column, and the unit that its axis has to name; none where the words name what is counted.
fn cell_and_unit(column: &str) -> (String, Option<String>) {
    let entries = explain(column).unwrap();
    match fact(&entries[0], "unit") {
        Some(unit @ ("s" | "B" | "%" | "ratio")) => ("1".to_owned(), Some(unit.to_owned())),
        Some("count") => ("1".to_owned(), None),
        Some(unit) => panic!("{column}: an axis of {unit}"),
        None => {
            let takes = fact(&entries[0], "takes").unwrap();
            let example = takes.split('"').nth(1);
            let unit = example.and_then(|example| Some(example.split_once(' ')?.1.to_owned()));
            (example.unwrap_or("1").to_owned(), unit)
        }
    }
}

#[test]
fn axes_of_all_shipped_plots_have_units() {
    let mut drawn = 0;
    for experiment in files("experiments") {
        let plots = experiment["plots"].as_array().cloned().unwrap_or_default();
        for plot in plots {
            let plot: Plot = serde_json::from_value(plot).unwrap();
            let axes = [&plot.x, &plot.y];
            let columns: Vec<String> =
                axes.iter().flat_map(|axis| axis.split('*').map(str::to_owned)).collect();
            let cells: Vec<_> = columns.iter().map(|column| cell_and_unit(column)).collect();
            let rows = vec![cells.iter().map(|(cell, _)| cell.clone()).collect()];
            let svg = lab::svg(&Table { columns: columns.clone(), rows }, &plot);
            for (column, (_, unit)) in columns.iter().zip(&cells) {
                let named = unit.as_ref().is_none_or(|unit| svg.contains(&format!("({unit})")));
                assert!(named, "{column}: no ({unit:?}) in {svg}");
            }
            drawn += 1;
        }
    }
    assert!(drawn > 20, "{drawn}");
}
