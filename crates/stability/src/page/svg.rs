//! The drawing: how wrong naive methods are, and how wrong this program is.

use std::fmt::Write;

use crate::finding::{Finding, Quantity};
use crate::suite::CaseResult;

/// The left end of the axis: shares below this are drawn here.
const LEAST: f64 = 1e-14;
const WIDTH: f64 = 980.0;
const LEFT: f64 = 410.0;
const STEP: f64 = 18.0;

/// The drawing: one line for each finding that is a share and has a naive method beside it.
pub fn svg(results: &[CaseResult]) -> String {
    let rows: Vec<(&CaseResult, &Finding)> = results
        .iter()
        .flat_map(|result| result.findings.iter().map(move |finding| (result, finding)))
        .filter(|(_, finding)| finding.ours.share().is_some() && finding.naive.is_some())
        .collect();
    let height = STEP * (rows.len() as f64 + 4.0);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    let foot = height - 1.6 * STEP;
    for power in (-12..=2).step_by(2) {
        let x = across(10_f64.powi(power));
        let _ = write!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{STEP}\" x2=\"{x:.1}\" y2=\"{foot:.1}\" stroke=\"#ddd\"/>\n\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">1e{power}</text>\n",
            foot + STEP
        );
    }
    let none = across(0.0);
    let _ = writeln!(
        svg,
        "<text x=\"{none:.1}\" y=\"{:.1}\" text-anchor=\"middle\">none</text>",
        foot + STEP
    );
    for (i, (result, finding)) in rows.into_iter().enumerate() {
        svg += &marks(result, finding, STEP * (i as f64 + 1.8));
    }
    svg + &legend() + "</svg>\n"
}

/// The x coordinate of a share, on a logarithmic axis.
fn across(share: f64) -> f64 {
    let powers = share.clamp(LEAST, 1e3).log10() - LEAST.log10();
    LEFT + 15.0 + (WIDTH - LEFT - 40.0) * powers / (3.0 - LEAST.log10())
}

/// The line of a case: its title, ours, the naive method's, and the bound.
fn marks(result: &CaseResult, finding: &Finding, y: f64) -> String {
    let title = result.case.title.replace('&', "&amp;").replace('<', "&lt;");
    let mut svg = format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{title}</text>\n",
        LEFT - 5.0,
        y + 4.0
    );
    let at = |quantity: &Quantity| quantity.share().map(across);
    if let Some(x) = at(&finding.bound) {
        let (top, bottom) = (y - 7.0, y + 7.0);
        let _ = writeln!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{top:.1}\" x2=\"{x:.1}\" y2=\"{bottom:.1}\" stroke=\"#555\"/>"
        );
    }
    let naive = finding.naive.as_ref().and_then(at);
    for (x, colour) in [(naive, NAIVE), (at(&finding.ours), OURS)] {
        let circle =
            |x| format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"{colour}\"/>\n");
        svg += &x.map_or(String::new(), circle);
    }
    svg
}

const NAIVE: &str = "#d55e00";
const OURS: &str = "#0072b2";

fn legend() -> String {
    let entry = |x: f64, colour: &str, text: &str| {
        format!(
            "<circle cx=\"{x}\" cy=\"9\" r=\"4.5\" fill=\"{colour}\"/><text x=\"{}\" y=\"13\">{text}</text>\n",
            x + 9.0
        )
    };
    entry(LEFT + 15.0, NAIVE, "a naive method")
        + &entry(LEFT + 140.0, OURS, "ours")
        + &format!(
            "<text x=\"{}\" y=\"13\">| right, up to here; share of rays or of light</text>\n",
            LEFT + 210.0
        )
}
