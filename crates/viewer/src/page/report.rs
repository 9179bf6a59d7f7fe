//! The parts of a report that come from recorded runs.

use super::assets::index_element;
use crate::explain::{AnalysedRun, answers, loss_table};
use crate::pack::Blocks;
use crate::record::RecordedRun;

/// The parts of a report that come from recorded runs.
pub struct ReportParts {
    /// Answers in words and tables of losses.
    pub answers: String,
    /// The viewer's data.
    pub data: String,
}

/// Where each part begins and ends in a report.
const MARKS: [&str; 2] = ["<!-- recorded: -->\n", "<!-- :recorded -->\n"];

impl ReportParts {
    /// The parts for `runs`, with at most about `limit` bytes of data, packed on `threads` threads.
    pub fn of(runs: &[RecordedRun], limit: usize, threads: usize) -> ReportParts {
        let runs: Vec<AnalysedRun> = runs.iter().map(AnalysedRun::of).collect();
        let blocks = Blocks::of(&runs, limit);
        let (index, blocks) = (index_element(&blocks.index), blocks.pack(threads));
        ReportParts { answers: marked(&all_answers(&runs)), data: marked(&(index + &blocks)) }
    }

    /// The parts of an earlier report, so that it can be written again without its runs.
    pub fn in_report(html: &str) -> Option<ReportParts> {
        let mut parts = html.split(MARKS[0]).skip(1).map(|rest| rest.split_once(MARKS[1]));
        let mut part = || Some(marked(parts.next()??.0));
        Some(ReportParts { answers: part()?, data: part()? })
    }
}

fn marked(part: &str) -> String {
    format!("{}{part}{}", MARKS[0], MARKS[1])
}

/// Runs by group, each group by rising number of processors.
fn groups<'a>(runs: &'a [AnalysedRun<'a>]) -> Vec<Vec<&'a AnalysedRun<'a>>> {
    let mut groups: Vec<Vec<&AnalysedRun>> = Vec::new();
    for one in runs {
        match groups.iter_mut().find(|group| group[0].run.group == one.run.group) {
            Some(group) => group.push(one),
            None => groups.push(vec![one]),
        }
    }
    groups.iter_mut().for_each(|group| group.sort_by_key(|run| run.processors()));
    groups
}

/// The words that the answers use.
const WORDS: &str = "<p>A <em>node</em> is a processor of the machine. It holds <em>local environments</em>, boxes \
    that the scene is cut into. In a <em>local shot</em> it casts the light of one of its own patches. Light that \
    leaves the box is sent to the neighbouring environments in messages; there each <em>received shot</em> continues \
    it.</p>\n";

/// For each group, the answers for its run on the most processors, and the table of its losses.
fn all_answers(runs: &[AnalysedRun]) -> String {
    let mut text = WORDS.to_owned();
    for group in groups(runs) {
        let Some(most) = group.last() else { continue };
        let alone = group.first().filter(|run| run.processors() == 1).copied();
        let items = answers(most, alone).into_iter();
        let items: String = items
            .map(|(question, answer)| format!("<dt>{question}</dt><dd>{answer}</dd>\n"))
            .collect();
        let label = escape(&most.run.label);
        text += &format!("<h3>{label}</h3>\n<dl class=\"answers\">\n{items}</dl>\n");
        if group.len() > 1 {
            text += &loss_table(&group);
        }
    }
    text
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
