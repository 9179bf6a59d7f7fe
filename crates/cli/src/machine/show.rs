//! `virtwall machine show`: a machine's numbers with their provenance, and a drawing of it.

use std::fmt::Write as _;

use clap::Args;
use lab::MachineFile;
use multicomputer::{Machine, Shape};
use serde_json::Value;

use crate::exit::Exit;

#[derive(Args)]
pub struct Arguments {
    /// Name of a machine, or path to a machine file
    machine: String,
}

/// Prints the machine.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    show(&arguments.machine)
}

/// A drawing of a machine, and its numbers.
pub fn show(name: &str) -> Result<String, Exit> {
    let open = MachineFile::open(name)?;
    let model = open.machine.network_model.map_or("auto", |model| model.name());
    let mut text = format!("{}\n{}\n\n", open.machine.title, drawing(&open.machine));
    let _ = writeln!(text, "Network model: {model}. Numbers, from {}:\n", open.label);
    numbers(&mut text, "", &open.value);
    Ok(text)
}

/// Writes a line for each number under `value`, with its provenance and source, and for each text, such
/// as the name of a model.
fn numbers(text: &mut String, place: &str, value: &Value) {
    let Value::Object(fields) = value else {
        // Texts at the top level, such as the title, describe the file.
        if let Some(word) = value.as_str().filter(|_| place.contains('.')) {
            let _ = writeln!(text, "{place} = {word}");
        }
        return;
    };
    if let Some(provenance) = fields.get("provenance").and_then(Value::as_str) {
        let word = |field: &str| match fields.get(field) {
            Some(Value::String(text)) => text.clone(),
            other => other.map_or(String::new(), Value::to_string),
        };
        let _ = writeln!(text, "{place} = {} ({provenance}: {})", word("value"), word("source"));
        return;
    }
    for (name, inner) in fields {
        let dot = if place.is_empty() { "" } else { "." };
        numbers(text, &format!("{place}{dot}{name}"), inner);
    }
}

/// Longest row that is drawn whole. Of a longer row only both ends are drawn.
const WIDEST: usize = 20;

/// Draws the topology row by row: compute nodes as numbers, service nodes as s, empty places as dots.
fn drawing(machine: &Machine) -> String {
    let (compute, nodes) = (machine.compute_nodes(), machine.nodes());
    let topology = machine.topology();
    let width = (compute.max(2) - 1).to_string().len();
    let place = |number: usize| match number {
        _ if number < compute => format!("{number:>width$}"),
        _ if number < nodes => format!("{:>width$}", "s"),
        _ => format!("{:>width$}", "."),
    };
    let (columns, name) = match topology.shape() {
        Shape::Mesh { width, height } => (width.into(), format!("a mesh, {width} x {height}")),
        Shape::Torus { width, height } => {
            (width.into(), format!("a torus, {width} x {height}, ends (~) joined"))
        }
        Shape::Crossbar { places } => (16, format!("a crossbar (#) of {places} places")),
        Shape::Bus { places } => (16, format!("a bus (=) with {places} places")),
    };
    let numbers: Vec<usize> = (0..topology.places()).collect();
    let rows = numbers.chunks(columns).map(|row| {
        let mut places: Vec<String> = row.iter().map(|&number| place(number)).collect();
        if places.len() > WIDEST {
            places.splice(WIDEST / 2..places.len() - WIDEST / 2, ["...".to_owned()]);
        }
        row_of(&places, topology.shape())
    });
    let service = machine.service_nodes();
    let s = if service == 1 { "" } else { "s" };
    let what = format!("{compute} compute nodes and {service} service node{s} (s) on {name}:\n\n");
    what + &rows.collect::<String>()
}

/// A row of places with their links.
fn row_of(places: &[String], shape: Shape) -> String {
    let hub = |sign: &str| {
        let row = places.join("   ");
        let links = places.iter().map(|place| format!("{:>1$}", "|", place.len()));
        let links = links.collect::<Vec<_>>().join("   ");
        format!("  {row}\n  {links}\n  {}\n", sign.repeat(row.len()))
    };
    match shape {
        Shape::Mesh { .. } => format!("  {}\n", places.join(" - ")),
        Shape::Torus { .. } => format!("  ~{}~\n", places.join(" - ")),
        Shape::Crossbar { .. } => hub("#"),
        Shape::Bus { .. } => hub("="),
    }
}
