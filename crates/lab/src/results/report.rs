//! The report: one HTML page that needs no other file.

use std::fmt::Write;

use serde_json::Value;
use viewer::ReportParts;

use crate::experiment::accuracy::REPLACED;
use crate::experiment::schema::FIELDS;
use crate::experiment::sweep::in_words;
use crate::results::console::{Line, lines};
use crate::results::summary::Summary;
use crate::results::without_time;
use crate::table::cheapest;
use crate::table::columns;
use crate::table::runs_csv::Table;

const STYLE: &str = include_str!("report.css");

/// Explains the column of ratios, if results are compared with published ones.
const RATIOS: &str = "<p>Ratios are simulated over paper: of speed-ups, and of times (t) on one \
                      processor.</p>\n";

/// The report. `runs` are the rows of runs.csv, `sweeps` the swept fields, `drawings` the plots as SVG, and
/// `recorded` the data of the viewer, if there is any.
pub fn html(
    manifest: &Value,
    runs: &Table,
    sweeps: &[String],
    drawings: &[String],
    recorded: Option<&ReportParts>,
) -> String {
    let lead = lead(manifest, runs);
    let compared = Summary::of(runs, sweeps).lines();
    let summary =
        compared.iter().map(|line| format!("<p class=\"summary\">{}</p>\n", escape(line)));
    let summary: String = summary.collect();
    let warnings = warnings(manifest, runs);
    let found = list("Settings found", "found", &texts(&manifest["settings_found"]));
    let figures = drawings.iter().map(|svg| format!("<figure>{svg}</figure>\n"));
    let figures: String = figures.collect();
    let ratios = if compared.is_empty() { "" } else { RATIOS };
    let grouped = grouped(&lines(runs, sweeps));
    let cheapest = cheapest(runs, sweeps);
    let all = table(&shown_columns(runs), runs);
    let choices = choices(manifest);
    let problems = problems(manifest);
    let experiment = serde_json::to_string_pretty(&manifest["experiment"]).unwrap_or_default();
    let experiment = escape(&experiment);
    let files = files(manifest);
    let [viewer_style, answers, data] = recorded.map(viewer_parts).unwrap_or_default();
    let body = format!(
        "{lead}{summary}{warnings}{found}{figures}{answers}\
         {cheapest}<h2>Runs</h2>\n{ratios}{grouped}\
         <details><summary>All columns</summary>\n{all}</details>\n\
         <h2>Choices</h2>\n\
         <p>What the paper leaves open, and what this experiment takes.</p>\n{choices}\
         <h2>Scenes</h2>\n{problems}\
         <h2>Configuration</h2>\n<p>Every field, defaults filled in. It is an experiment file \
         that gives these results again.</p>\n<pre>{experiment}</pre>\n\
         <h2>Files</h2>\n{files}{data}"
    );
    page(&in_words(&manifest["title"]), &viewer_style, &body)
}

pub fn page(title: &str, style: &str, body: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{STYLE}{style}</style>\n</head>\n<body>\n\
         <h1>{title}</h1>\n{body}</body>\n</html>\n"
    )
}

/// The viewer: its style, its part of the body, and its data at the end of the page.
fn viewer_parts(recorded: &ReportParts) -> [String; 3] {
    let answers =
        format!("<h2>What happened, and why</h2>\n{}{}", recorded.answers, viewer::MARKUP);
    let data = format!("{}{}", recorded.data, viewer::program());
    [viewer::STYLE.to_owned(), answers, data]
}

fn lead(manifest: &Value, runs: &Table) -> String {
    let on = match manifest["on"].as_str() {
        Some("threads") => "on this host's threads",
        _ => "on a simulated machine; times are virtual",
    };
    let runs = runs.rows.len();
    let version = escape(&in_words(&manifest["virtwall"]));
    let seed = escape(&in_words(&manifest["seed"]));
    let plural = if runs == 1 { "" } else { "s" };
    let note = without_time::note(manifest).map_or(String::new(), |note| format!(" {note}"));
    format!(
        "<p class=\"lead\">{runs} run{plural} {on}. Virtwall {version}, seed {seed}.{note}</p>\n"
    )
}

fn warnings(manifest: &Value, runs: &Table) -> String {
    let mut items = texts(&manifest["warnings"]);
    for row in &runs.rows {
        let cell = |column| runs.cell(row, column);
        let run = format!("{} on {} processors", cell("scene"), cell("processors"));
        match cell("ending") {
            "failed" => items.push(format!("{run} failed: {}", cell("failure"))),
            "too_early" => items.push(format!(
                "{run}: the end was announced too early; {} of the emitted energy is lost",
                cell("energy_lost")
            )),
            _ => {}
        }
    }
    list("Warnings", "warnings", &items)
}

fn texts(list: &Value) -> Vec<String> {
    list.as_array().into_iter().flatten().map(in_words).collect()
}

fn list(title: &str, class: &str, items: &[String]) -> String {
    if items.is_empty() {
        return String::new();
    }
    let items: String = items.iter().map(|item| format!("<li>{}</li>\n", escape(item))).collect();
    format!("<h2>{title}</h2>\n<ul class=\"{class}\">\n{items}</ul>\n")
}

/// The runs as a table like Table 1, with a group of rows for each scene.
fn grouped(lines: &[Line]) -> String {
    let mut rows = String::new();
    let mut group = None;
    for line in lines {
        if group != Some(&line.group) {
            let name = escape(&line.group);
            rows += &format!("<tr class=\"group\"><th colspan=\"7\">{name}</th></tr>\n");
            group = Some(&line.group);
        }
        let cells = [&line.processors].into_iter().chain(&line.simulated).chain(&line.paper);
        let cells = cells.chain([&line.ratio, &line.note]);
        let cells: String = cells.map(|cell| format!("<td>{}</td>", escape(cell))).collect();
        rows += &format!("<tr>{cells}</tr>\n");
    }
    format!(
        "<div class=\"wide\"><table>\n<thead>\n\
         <tr><th></th><th colspan=\"2\">simulated</th><th colspan=\"2\">paper</th><th></th><th></th></tr>\n\
         <tr><th>processors</th><th>time s</th><th>speed-up</th><th>time s</th><th>speed-up</th>\
         <th>ratio</th><th></th></tr>\n</thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

/// The section on what accuracy costs, if runs have errors.
fn cheapest(runs: &Table, sweeps: &[String]) -> String {
    let cheapest = cheapest::cheapest(runs, sweeps);
    if cheapest.is_empty() {
        return String::new();
    }
    let row = |c: &cheapest::Cheapest| {
        let cells = c.cells();
        let cells = cells.iter().map(|cell| format!("<td class=\"text\">{}</td>", escape(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows: String = cheapest.iter().map(row).collect();
    let head = ["scene", "error at most", "time s", "found", "cheapest setting"];
    let head = head.map(|cell| format!("<th class=\"text\">{cell}</th>")).concat();
    format!(
        "<h2>What accuracy costs</h2>\n<div class=\"wide\"><table>\n<thead><tr>{head}</tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table></div>\n"
    )
}

/// The columns of runs.csv that are not empty, except those whose cells are too long for a page.
fn shown_columns(table: &Table) -> Vec<&str> {
    let holds = |column: &&str| table.rows.iter().any(|row| !table.cell(row, column).is_empty());
    let names = table.columns.iter().map(String::as_str);
    names.filter(|name| !["operations", "failure"].contains(name)).filter(holds).collect()
}

fn table(names: &[&str], table: &Table) -> String {
    let head: String = names.iter().map(|name| heading(name)).collect();
    let mut rows = String::new();
    for row in &table.rows {
        let cells = names.iter().map(|name| format!("<td>{}</td>", escape(table.cell(row, name))));
        // Writing to a string cannot fail.
        let _ = writeln!(rows, "<tr>{}</tr>", cells.collect::<String>());
    }
    format!(
        "<div class=\"wide\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\n\
         </table></div>\n"
    )
}

/// The table of all fields whose description marks a choice, with their values in this experiment.
fn choices(manifest: &Value) -> String {
    let mut rows = Vec::new();
    collect_choices(&FIELDS, &manifest["experiment"], "", &mut rows);
    rows.sort();
    let finds = !manifest["experiment"]["accuracy"].is_null();
    let rows = rows.into_iter().map(|(number, field, value, about)| {
        let found = finds && REPLACED.contains(&field.as_str());
        let value = if found { "found".to_owned() } else { value };
        format!(
            "<tr><td>C{number}</td><td class=\"text\"><code>{}</code></td><td class=\"text\">{}</td>\
             <td class=\"text about\">{}</td></tr>\n",
            escape(&field),
            escape(&value),
            escape(&about)
        )
    });
    let head = "<thead><tr><th></th><th class=\"text\">field</th><th class=\"text\">here</th><th></th></tr></thead>";
    format!(
        "<div class=\"wide\"><table>{head}<tbody>\n{}</tbody></table></div>\n",
        rows.collect::<String>()
    )
}

type ChoiceRow = (u32, String, String, String);

fn collect_choices(schema: &Value, value: &Value, path: &str, rows: &mut Vec<ChoiceRow>) {
    for (name, schema) in schema["properties"].as_object().into_iter().flatten() {
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        let about = schema["description"].as_str().unwrap_or_default();
        if let Some(number) = choice_number(about) {
            let here = match &value[name] {
                Value::Null => "default".to_owned(),
                Value::Array(items) => items.iter().map(in_words).collect::<Vec<_>>().join(", "),
                one => in_words(one),
            };
            rows.push((number, path.clone(), here, about.to_owned()));
        }
        collect_choices(schema, &value[name], &path, rows);
    }
}

fn choice_number(about: &str) -> Option<u32> {
    let (_, rest) = about.split_once("Choice C")?;
    rest.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

fn problems(manifest: &Value) -> String {
    let problems = manifest["problems"].as_array().map_or(&[][..], Vec::as_slice);
    let Some(first) = problems.first().and_then(Value::as_object) else { return String::new() };
    let names: Vec<&str> = first.keys().map(String::as_str).collect();
    let cells = |problem: &Value| names.iter().map(|&name| in_words(&problem[name])).collect();
    let columns = names.iter().map(|&name| name.to_owned()).collect();
    table(&names, &Table { columns, rows: problems.iter().map(cells).collect() })
}

fn files(manifest: &Value) -> String {
    let row = |(name, digest): (&String, &Value)| {
        let digest = in_words(digest);
        format!("<tr><td>{}</td><td><code>{}</code></td></tr>\n", escape(name), escape(&digest))
    };
    let rows: String = manifest["files"].as_object().into_iter().flatten().map(row).collect();
    format!(
        "<div class=\"wide\"><table><thead><tr><th>file</th><th>SHA-256</th></tr></thead><tbody>\n\
         {rows}</tbody></table></div>\n"
    )
}

/// The head of a column; what it holds is shown where the mouse rests on it.
fn heading(column: &str) -> String {
    let about = columns::about(column).map(|about| format!(" title=\"{}\"", escape(&about)));
    let name = escape(column).replace('_', " ");
    format!("<th{}>{name}</th>", about.unwrap_or_default())
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
