//! `virtwall list`: all that has a name, with a line of what it is.

use clap::{Args, ValueEnum};
use config::Document;
use lab::{Entry, FileKind, Found, Term, all_here, glossary};
use serde_json::{Map, Value, json};

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// List only what is of this kind
    #[arg(value_enum)]
    kind: Option<Listed>,
    /// Text, or JSON for other programs
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Listed {
    /// Scenes here and built in
    Scenes,
    /// Machines here and built in
    Machines,
    /// Experiments here and built in
    Experiments,
    /// Models of the network
    NetworkModels,
    /// Columns of runs.csv, and what plots draw besides
    Columns,
    /// Fields of experiment, machine and scene files
    Fields,
    /// Choices that the code makes where the paper is silent
    Choices,
}

/// Each name with what it is, and whether a file is built in.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let all = glossary();
    let kinds = Listed::value_variants().iter();
    let kinds = kinds.filter(|kind| arguments.kind.is_none_or(|only| only == **kind));
    let listed = kinds.map(|kind| (kind.heading(), kind.rows(&all).into()));
    let listed: Map<String, Value> = listed.collect();
    let text = match arguments.format {
        Format::Json => serde_json::to_string_pretty(&listed).map_err(Exit::failure)? + "\n",
        Format::Text => listed.iter().map(|(heading, rows)| section(heading, rows)).collect(),
    };
    Ok(text)
}

impl Listed {
    fn heading(self) -> String {
        let value = self.to_possible_value();
        value.map_or(String::new(), |value| value.get_name().replace('-', "_"))
    }

    fn rows(self, all: &[Entry]) -> Vec<Value> {
        let files = |kind| all_here(&kind).iter().map(file).collect();
        let entries = |terms: &[Term]| {
            all.iter().filter(|entry| terms.contains(&entry.term)).map(term).collect()
        };
        match self {
            Listed::Scenes => files(FileKind::SCENES),
            Listed::Machines => files(FileKind::MACHINES),
            Listed::Experiments => files(FileKind::EXPERIMENTS),
            Listed::NetworkModels => entries(&[Term::NetworkModel]),
            Listed::Columns => entries(&[Term::Column]),
            Listed::Fields => {
                entries(&[Term::ExperimentField, Term::MachineField, Term::SceneField])
            }
            Listed::Choices => entries(&[Term::Choice]),
        }
    }
}

fn file(found: &Found) -> Value {
    let document = Document::read(&found.path);
    let title =
        document.map_or_else(|fault| fault.to_string().into(), |file| file.value["title"].clone());
    json!({
        "name": found.path.file_stem().unwrap_or_default().to_string_lossy(),
        "title": title,
        "built_in": shipped::file(&found.path).is_some(),
    })
}

fn term(entry: &Entry) -> Value {
    let mut row = json!({ "name": entry.name, "title": entry.line() });
    let of = match entry.term {
        Term::ExperimentField => "experiment",
        Term::MachineField => "machine",
        Term::SceneField => "scene",
        _ => "",
    };
    if !of.is_empty() {
        row["file"] = of.into();
    }
    for (fact, value) in &entry.facts {
        row[*fact] = value.as_str().into();
    }
    row
}

fn section(heading: &str, rows: &Value) -> String {
    let rows: Vec<&Value> = rows.as_array().into_iter().flatten().collect();
    let text = |row: &Value, key: &str| row[key].as_str().unwrap_or_default().to_owned();
    let longest = rows.iter().map(|row| text(row, "name").chars().count()).max();
    let width = longest.unwrap_or(0).max(20) + 2;
    let line = |row: &&Value| {
        let [name, title] = ["name", "title"].map(|key| text(row, key));
        let beside = match (text(row, "file"), text(row, "unit")) {
            _ if row["built_in"] == false => " (in this folder)".to_owned(),
            (file, _) if !file.is_empty() => format!(" ({file})"),
            (_, unit) if !unit.is_empty() => format!(" ({unit})"),
            _ => String::new(),
        };
        format!("  {name:<width$}{title}{beside}\n")
    };
    format!("{}\n{}\n", heading.replace('_', " "), rows.iter().map(line).collect::<String>())
}
