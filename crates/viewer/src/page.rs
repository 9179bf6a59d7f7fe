//! The viewer's part of a report: its markup, its blocks of data, its program.

use serde_json::Value;

use crate::answers;
use crate::data::Data;
use crate::reel::{Reel, Told};

/// The viewer without its data.
pub const MARKUP: &str = include_str!("../assets/viewer.html");
/// How the viewer looks.
pub const STYLE: &str = include_str!("../assets/viewer.css");
/// What it does, in the order in which each part needs those before; what starts it comes last.
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
    /// The recordings of some runs, at most about `limit` bytes of them, packed by so many threads.
    pub fn of(reels: &[Reel], limit: usize, threads: usize) -> Recorded {
        let told: Vec<Told> = reels.iter().map(Told::of).collect();
        let data = Data::of(&told, limit);
        let (index, blocks) = (index_element(&data.index), data.packed(threads));
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
    script(&[include_str!("../assets/start.js")])
}

/// The program with what starts it.
pub(crate) fn script(start: &[&str]) -> String {
    let [program, start] = [PROGRAM.concat(), start.concat()];
    format!("<script>\n\"use strict\";\n{{\n{program}{start}}}\n</script>\n")
}

/// The index of what lies where, as an element of the page.
pub(crate) fn index_element(index: &Value) -> String {
    format!("<script type=\"application/json\" id=\"viewer-index\">{}</script>\n", embedded(index))
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

/// What one must know to read the answers.
const WORDS: &str = "<p>A <em>node</em> is a processor of the machine and holds <em>local environments</em>, boxes \
    that the scene is cut into. In a <em>local shot</em> it casts the light of a patch of its own; what leaves the box \
    goes on to its neighbours in messages, and each continues it in a <em>received shot</em>.</p>\n";

/// For each group what its run on the most processors tells, and the table of all.
fn answers(told: &[Told]) -> String {
    let mut text = WORDS.to_owned();
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

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
