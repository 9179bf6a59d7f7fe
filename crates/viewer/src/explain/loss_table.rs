//! A table of runs that differ only in the number of processors: what limits the speed-up.

use std::fmt::Write;

use super::analysed_run::AnalysedRun;
use super::format::{factor, percent, seconds};
use super::loss::Loss;

/// The table in HTML; runs come by rising number of processors.
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
