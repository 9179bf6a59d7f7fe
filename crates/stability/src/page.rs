//! The page of failures: words, a table, and a drawing.

use std::fmt::Write;

use serde_json::Value;

use crate::case::{Listed, Overlay};
use crate::finding::{Count, Finding, Said};
use crate::suite::Verdict;

/// The columns of the table.
const COLUMNS: [&str; 6] = ["case", "measure", "naive", "ours", "right", "holds"];

/// The page, in Markdown; the drawing is a file beside it.
pub fn page(verdicts: &[Verdict]) -> String {
    let wrong = verdicts.iter().filter(|verdict| !verdict.holds()).count();
    let all = verdicts.len();
    let mut text = format!(
        "# Where radiosity by rays fails\n\n\
         Made by `virtwall stability`, from the cases in `experiments/stability`. {} of {all} cases are as they\n\
         should be. Naive methods are run too, on the same scenes: up to 200,000 rays where they cast any.\n\n\
         ![How wrong naive methods are, and ours](stability.svg)\n",
        all - wrong
    );
    for listed in Listed::ALL {
        let of = || verdicts.iter().filter(move |verdict| verdict.case.listed == listed);
        let _ = write!(text, "\n## {}\n\n", listed.heading());
        text += "| failure | a naive method | ours | right |\n|---|---|---|---|\n";
        of().for_each(|verdict| text += &row(verdict));
    }
    text
}

/// A case as a row of the page.
fn row(verdict: &Verdict) -> String {
    let case = &verdict.case;
    let each = |of: &dyn Fn(&Finding) -> String| {
        let cells: Vec<String> = verdict.findings.iter().map(of).collect();
        cells.into_iter().filter(|cell| !cell.is_empty()).collect::<Vec<_>>().join("<br>")
    };
    let set = || format!("`{}`", settings(&case.naive_settings, "")).replace("``", "");
    let how = case.naive.map_or_else(set, |twin| twin.words().to_owned());
    let naive = each(&|finding| {
        finding.naive.as_ref().map_or(String::new(), |said| told(finding.measure, said))
    });
    let naive =
        [how, naive].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(": ");
    let ours = each(&|finding| {
        let mark = if finding.holds { "" } else { "**wrong** " };
        format!("{mark}{}", told(finding.measure, &finding.ours))
    });
    let right = each(&|finding| bound(finding));
    let cells = [
        format!("**{}** (`{}`). {}", case.title, verdict.name, case.failure),
        naive,
        format!("{ours}<br>{}", case.remedy),
        right,
    ];
    let cells = cells.map(|cell| cell.replace('|', "\\|").replace('\n', " "));
    format!("| {} |\n", cells.join(" | "))
}

/// Fields and their values, as `--set` takes them.
fn settings(fields: &Overlay, path: &str) -> String {
    let field = |(name, value): (&String, &Value)| match value {
        Value::Object(fields) => settings(fields, &format!("{path}{name}.")),
        Value::String(text) => format!("{path}{name}={text}"),
        value => format!("{path}{name}={value}"),
    };
    fields.iter().map(field).collect::<Vec<_>>().join(", ")
}

/// What was found, in words.
fn told(measure: &str, said: &Said) -> String {
    match said {
        Said::Count(Count { wrong, of }) => {
            let what = match measure {
                "leaks" => "rays lost",
                "owners" => "rays lost or claimed twice",
                "dark" => "patches in the dark",
                "torn" => "rays torn",
                _ => "rays astray",
            };
            format!("{} of {} {what}", thousands(*wrong), thousands(*of))
        }
        Said::Number(number) => format!("{} {}", name(measure), short(*number)),
        Said::Whole(number) => format!("{} {}", thousands(*number), name(measure)),
        Said::Words(words) => words.clone(),
    }
}

fn name(measure: &str) -> &str {
    match measure {
        "closure" => "energy unaccounted for",
        "brightest" => "brightest over the lamp",
        "exact" => "off the exact answer",
        "same_light" => "light differs by",
        "no_numbers" => "are no numbers",
        "shots" => "shots",
        other => other,
    }
}

fn bound(finding: &Finding) -> String {
    match &finding.bound {
        Said::Count(Count { wrong, .. }) => thousands(*wrong),
        Said::Number(number) => format!("≤ {}", short(*number)),
        Said::Whole(number) => thousands(*number),
        Said::Words(words) => format!("“{words}”"),
    }
}

/// Less than this is rounding, and told as less: it says nothing, and another compiler's may differ.
const ROUNDING: f64 = 1e-12;

/// Two significant digits.
fn short(number: f64) -> String {
    if number < ROUNDING && number > 0.0 {
        return format!("< {ROUNDING:e}");
    }
    if number == 0.0 || (1e-2..1e4).contains(&number) {
        let text = format!("{number:.3}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{number:.1e}").replace(".0e", "e")
}

fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// The table, as CSV: a line a finding.
///
/// # Errors
/// The writer's.
pub fn csv(verdicts: &[Verdict]) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS)?;
    for verdict in verdicts {
        for finding in &verdict.findings {
            let naive = finding.naive.as_ref().map_or(String::new(), raw);
            let (ours, right) = (raw(&finding.ours), raw(&finding.bound));
            let holds = finding.holds.to_string();
            writer.write_record([&verdict.name, finding.measure, &naive, &ours, &right, &holds])?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn raw(said: &Said) -> String {
    match said {
        Said::Count(Count { wrong, of }) => format!("{wrong} of {of}"),
        Said::Number(number) if *number > 0.0 && *number < ROUNDING => format!("<{ROUNDING:e}"),
        Said::Number(number) => format!("{number:.2e}"),
        Said::Whole(number) => number.to_string(),
        Said::Words(words) => words.clone(),
    }
}

/// Where the drawing has none, and all that is less.
const LEAST: f64 = 1e-14;
const WIDTH: f64 = 980.0;
const LEFT: f64 = 410.0;
const STEP: f64 = 18.0;

/// The drawing: for each finding that is a share of what there is, how wrong a naive method is and how
/// wrong ours.
pub fn svg(verdicts: &[Verdict]) -> String {
    let rows: Vec<(&Verdict, &Finding)> = verdicts
        .iter()
        .flat_map(|verdict| verdict.findings.iter().map(move |finding| (verdict, finding)))
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
    for (i, (verdict, finding)) in rows.into_iter().enumerate() {
        svg += &marks(verdict, finding, STEP * (i as f64 + 1.8));
    }
    svg + &legend() + "</svg>\n"
}

/// Where a share stands.
fn across(share: f64) -> f64 {
    let powers = share.clamp(LEAST, 1e3).log10() - LEAST.log10();
    LEFT + 15.0 + (WIDTH - LEFT - 40.0) * powers / (3.0 - LEAST.log10())
}

/// A case's line: its name, ours, the naive method's, and what is right.
fn marks(verdict: &Verdict, finding: &Finding, y: f64) -> String {
    let title = verdict.case.title.replace('&', "&amp;").replace('<', "&lt;");
    let mut svg = format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{title}</text>\n",
        LEFT - 5.0,
        y + 4.0
    );
    let at = |said: &Said| said.share().map(across);
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
