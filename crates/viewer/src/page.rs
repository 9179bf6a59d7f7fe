//! The viewer's part of a report: its markup, its blocks of data, its program.

use std::sync::Arc;

use serde_json::{Value, json};
use virtwall::Problem;

use crate::answers;
use crate::budget::affordable;
use crate::columns::Columns;
use crate::reel::{Reel, Told, places};
use crate::run;
use crate::scene::{Shots, geometry};

/// The viewer without its data.
pub const MARKUP: &str = include_str!("../assets/viewer.html");
/// How the viewer looks.
pub const STYLE: &str = include_str!("../assets/viewer.css");
/// What it does, in the order in which each part needs those before.
const PROGRAM: [&str; 16] = [
    include_str!("../assets/bytes.js"),
    include_str!("../assets/matrices.js"),
    include_str!("../assets/scene.js"),
    include_str!("../assets/run.js"),
    include_str!("../assets/light.js"),
    include_str!("../assets/state.js"),
    include_str!("../assets/camera.js"),
    include_str!("../assets/shaders.js"),
    include_str!("../assets/picture.js"),
    include_str!("../assets/light-panel.js"),
    include_str!("../assets/steer.js"),
    include_str!("../assets/tree.js"),
    include_str!("../assets/mesh.js"),
    include_str!("../assets/timeline.js"),
    include_str!("../assets/charts.js"),
    include_str!("../assets/main.js"),
];

/// The most messages of a run that a report holds.
const MOST_MESSAGES: usize = 60_000;

/// What a report holds of its recorded runs.
pub struct Recorded {
    /// In words and in a table: what happened and why.
    pub answers: String,
    /// The viewer's data.
    pub data: String,
}

/// Marks where the parts of [`Recorded`] begin and end in a report.
const MARKS: [&str; 2] = ["<!-- recorded: -->\n", "<!-- :recorded -->\n"];

impl Recorded {
    /// The recordings of some runs, at most about `limit` bytes of them.
    pub fn of(reels: &[Reel], limit: usize) -> Recorded {
        let told: Vec<Told> = reels.iter().map(Told::of).collect();
        let Data { index, blocks } = Data::of(&told, limit);
        let index = embedded(&index);
        let index =
            format!("<script type=\"application/json\" id=\"viewer-index\">{index}</script>\n");
        Recorded { answers: marked(&answers(&told)), data: marked(&(index + &blocks)) }
    }

    /// What an earlier report holds, so that it can be drawn anew.
    pub fn in_report(html: &str) -> Option<Recorded> {
        let mut parts = html.split(MARKS[0]).skip(1).map(|rest| rest.split_once(MARKS[1]));
        let mut part = || Some(marked(parts.next()??.0));
        Some(Recorded { answers: part()?, data: part()? })
    }
}

fn marked(part: &str) -> String {
    format!("{}{part}{}", MARKS[0], MARKS[1])
}

/// The program, as a script of the page.
pub fn program() -> String {
    format!("<script>\n\"use strict\";\n{{\n{}}}\n</script>\n", PROGRAM.concat())
}

/// JSON that can stand in a page.
fn embedded(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

/// Runs of one group, by rising processors.
fn groups<'a>(told: &'a [Told<'a>]) -> Vec<Vec<&'a Told<'a>>> {
    let mut groups: Vec<Vec<&Told>> = Vec::new();
    for one in told {
        match groups.iter_mut().find(|group| group[0].reel.group == one.reel.group) {
            Some(group) => group.push(one),
            None => groups.push(vec![one]),
        }
    }
    groups.iter_mut().for_each(|group| group.sort_by_key(|told| told.processors()));
    groups
}

/// For each group what its run on the most processors tells, and the table of all.
fn answers(told: &[Told]) -> String {
    let mut text = String::new();
    for group in groups(told) {
        let Some(most) = group.last() else { continue };
        let alone = group.first().filter(|told| told.processors() == 1).copied();
        let items = answers::answers(most, alone).into_iter();
        let items: String =
            items.map(|(asked, answer)| format!("<dt>{asked}</dt><dd>{answer}</dd>\n")).collect();
        text += &format!(
            "<h3>{}</h3>\n<dl class=\"answers\">\n{items}</dl>\n",
            escape(&most.reel.label)
        );
        if group.len() > 1 {
            text += &answers::table(&group);
        }
    }
    text
}

/// The blocks of a page, and what lies where.
struct Data {
    index: Value,
    blocks: String,
}

impl Data {
    fn of(told: &[Told], limit: usize) -> Data {
        let shown = affordable(told, limit);
        let told: Vec<&Told> =
            told.iter().zip(&shown).filter(|(_, shown)| **shown).map(|(told, _)| told).collect();
        let mut problems: Vec<&Arc<Problem>> = Vec::new();
        for one in &told {
            if !problems.iter().any(|problem| Arc::ptr_eq(problem, one.reel.problem)) {
                problems.push(one.reel.problem);
            }
        }
        let mut data = Data { index: Value::Null, blocks: String::new() };
        let (mut scenes, mut runs) = (Vec::new(), vec![Value::Null; told.len()]);
        let mut sampled = Vec::new();
        if told.len() < shown.len() {
            sampled.push(format!(
                "{} of {} recorded runs are here; with more the page would be too large",
                told.len(),
                shown.len()
            ));
        }
        for (number, problem) in problems.iter().enumerate() {
            let mine =
                || told.iter().enumerate().filter(|(_, t)| Arc::ptr_eq(t.reel.problem, problem));
            let shots = Shots::of(mine().map(|(_, told)| told.reel.film));
            let name = mine().next().map_or("", |(_, told)| told.reel.scene.as_str());
            let answer = mine().find_map(|(_, told)| told.reel.answer.as_ref());
            let answer = answer.map(|answer| {
                let mut columns = Columns::default();
                columns.floats(answer.iter().flat_map(|rgb| rgb.to_array()));
                data.add(&format!("reference-{number}"), &columns)
            });
            scenes.push(json!({
                "name": name,
                "block": data.add(&format!("scene-{number}"), &geometry(problem)),
                "shots": data.add(&format!("shots-{number}"), &shots.columns(problem)),
                "reference": answer,
            }));
            for (run, told) in mine() {
                let messages = told.reel.film.recording.messages.len();
                let every = messages.div_ceil(MOST_MESSAGES).max(1);
                if every > 1 {
                    sampled.push(format!("{}, one message of {every}", told.reel.label));
                }
                let columns =
                    run::columns(told.reel.film, &told.reel.owners, &shots, &told.path, every);
                runs[run] = entry(told, number, data.add(&format!("run-{run}"), &columns));
            }
        }
        data.index = json!({
            "scenes": scenes,
            "runs": runs,
            "first": first(&told),
            "note": match sampled.is_empty() {
                true => "All that was recorded is here: every shot, span and message.".to_owned(),
                false => format!("Sampled: {}.", sampled.join("; ")),
            },
        });
        data
    }

    fn add(&mut self, id: &str, columns: &Columns) -> String {
        let packed = columns.pack();
        self.blocks +=
            &format!("<script type=\"application/octet-stream\" id=\"{id}\">{packed}</script>\n");
        id.to_owned()
    }
}

fn entry(told: &Told, scene: usize, block: String) -> Value {
    json!({
        "label": told.reel.label,
        "group": told.reel.group,
        "scene": scene,
        "processors": told.processors(),
        "time_s": told.seconds(),
        "machine": places(told.reel),
        "block": block,
    })
}

/// The run that is shown first: of the first group the one on the most processors.
fn first(told: &[&Told]) -> usize {
    let group = told.first().map_or(0, |one| one.reel.group);
    let mine = told.iter().enumerate().filter(|(_, one)| one.reel.group == group);
    mine.max_by_key(|(_, one)| one.processors()).map_or(0, |(run, _)| run)
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
