//! `virtwall list`: the scenes, machines and experiments that have names here.

use clap::{Args, ValueEnum};
use config::Document;
use lab::{FileKind, Found, all_here};
use serde_json::{Value, json};

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// Text, or JSON for other programs
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// The kinds, with the heading of each.
const KINDS: [(&str, FileKind); 3] = [
    ("scenes", FileKind::SCENES),
    ("machines", FileKind::MACHINES),
    ("experiments", FileKind::EXPERIMENTS),
];

/// Each name with its title and whether it is built in.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let rows = |kind: &FileKind| all_here(kind).iter().map(row).collect::<Vec<Value>>();
    let listed = KINDS.iter().map(|(heading, kind)| ((*heading).to_owned(), rows(kind).into()));
    let listed: serde_json::Map<String, Value> = listed.collect();
    let text = match arguments.format {
        Format::Json => serde_json::to_string_pretty(&listed).map_err(Exit::failure)? + "\n",
        Format::Text => listed.iter().map(|(heading, rows)| section(heading, rows)).collect(),
    };
    Ok(text)
}

fn row(found: &Found) -> Value {
    let document = Document::read(&found.path);
    let title =
        document.map_or_else(|fault| fault.to_string().into(), |file| file.value["title"].clone());
    json!({
        "name": found.path.file_stem().unwrap_or_default().to_string_lossy(),
        "title": title,
        "built_in": shipped::file(&found.path).is_some(),
    })
}

fn section(heading: &str, rows: &Value) -> String {
    let line = |row: &Value| {
        let [name, title] = ["name", "title"].map(|key| row[key].as_str().unwrap_or_default());
        let place = if row["built_in"] == true { "" } else { " (in this folder)" };
        format!("  {name:<22}{title}{place}\n")
    };
    let lines: String = rows.as_array().into_iter().flatten().map(line).collect();
    format!("{heading}\n{lines}\n")
}
