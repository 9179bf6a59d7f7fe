//! The gap to a perfect speed-up, as a product of factors.

use std::fmt::Write;

use super::analysed_run::AnalysedRun;
use super::format::{factor, percent, seconds};
use crate::record::NodeState;

/// Factors whose product is the number of processors divided by the speed-up.
pub(super) struct Loss {
    /// Time on one processor or, where that is not known, the sum of all nodes' computing, seconds.
    pub base: f64,
    /// Work divided by the work on one processor.
    pub more: f64,
    /// The busiest node's work divided by the mean.
    pub uneven: f64,
    /// The run's time divided by the time that its busiest node computed.
    pub waits: f64,
}

impl Loss {
    /// `alone` is the same run on one processor, if that was recorded.
    pub fn of(run: &AnalysedRun, alone: Option<&AnalysedRun>) -> Loss {
        let work = run.all.computing();
        let busiest = run.nodes[run.busiest].computing();
        if busiest == 0.0 {
            return Loss { base: run.seconds(), more: 1.0, uneven: 1.0, waits: 1.0 };
        }
        let base = alone.map_or(work, AnalysedRun::seconds);
        let uneven = busiest * run.processors() as f64 / work;
        Loss { base, more: work / base, uneven, waits: run.seconds() / busiest }
    }

    /// In words, the factor that makes up more than half of the loss, if one does.
    pub fn verdict(&self, run: &AnalysedRun) -> &'static str {
        let busiest = &run.nodes[run.busiest];
        let whole = self.more * self.uneven * self.waits;
        let rest = [busiest.waiting(), busiest.overhead(), busiest.in_state(NodeState::Paging)];
        let most = rest.iter().copied().fold(0.0, f64::max);
        let waits = match rest.iter().position(|&part| part == most) {
            Some(1) => "Its busiest node spends its time on messages.",
            Some(2) => "Its busiest node spends its time paging.",
            _ => "Its busiest node waits for light from other nodes.",
        };
        let causes = [
            (self.more, "It does more work than one processor does."),
            (self.uneven, "The work is unevenly distributed over its nodes."),
            (self.waits, waits),
        ];
        let main = causes.iter().find(|(factor, _)| factor.ln() > 0.5 * whole.ln());
        match main {
            _ if whole < 1.25 => "Little is lost.",
            Some((_, cause)) => cause,
            None => "No single cause dominates.",
        }
    }
}

/// A table in HTML of the losses of runs that differ only in the number of processors, by rising number.
pub(crate) fn loss_table(runs: &[&AnalysedRun]) -> String {
    let alone = runs.iter().find(|run| run.processors() == 1).copied();
    let mut rows = String::new();
    for run in runs {
        let whole = run.seconds() * run.processors() as f64;
        let loss = Loss::of(run, alone);
        let share = |part: f64| percent(part / whole).replace("under", "&lt;");
        let cells = [
            seconds(run.seconds()),
            format!("{:.1}", loss.base / run.seconds()),
            factor(loss.more),
            factor(loss.uneven),
            factor(loss.waits),
            format!("{} ({})", run.busiest, seconds(run.nodes[run.busiest].computing())),
            run.with_sources.to_string(),
            share(run.all.computing()),
            share(run.all.overhead()),
            share(run.all.before),
            share(run.all.between),
            share(run.all.after),
        ];
        let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        let _ = writeln!(rows, "<tr><th scope=\"row\">{}</th>{cells}</tr>", run.processors());
    }
    format!(
        "<div class=\"wide\"><table class=\"losses\">{HEAD}<tbody>\n{rows}</tbody></table></div>\n"
    )
}

const HEAD: &str = "<caption>The speed-up times the three missing factors is the number of processors. The factors: \
    work compared with one processor, the busiest node\u{2019}s work compared with the mean, and the whole time \
    compared with the time that the busiest node computes.</caption>\n<thead><tr><td colspan=\"3\"></td>\
    <th colspan=\"3\" scope=\"colgroup\">missing factors</th><td colspan=\"2\"></td>\
    <th colspan=\"2\" scope=\"colgroup\">share of all time</th>\
    <th colspan=\"3\" scope=\"colgroup\">waiting, of all time</th></tr>\n<tr><th scope=\"col\">processors</th>\
    <th scope=\"col\">time</th><th scope=\"col\">speed-up</th><th scope=\"col\">more work</th>\
    <th scope=\"col\">uneven</th><th scope=\"col\">waits</th><th scope=\"col\">busiest node</th>\
    <th scope=\"col\">nodes with sources</th><th scope=\"col\">computing</th><th scope=\"col\">messages</th>\
    <th scope=\"col\">before</th><th scope=\"col\">between</th>\
    <th scope=\"col\">after shots</th></tr></thead>";
