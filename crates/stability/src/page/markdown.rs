//! The page of failures in Markdown: a table for each list of failures.

use std::fmt::Write;

use serde_json::Value;

use crate::cases::case::{Listed, Overlay};
use crate::finding::{Count, Finding, Quantity, ROUNDING};
use crate::suite::CaseResult;

/// The page. It shows `stability.svg` from the same folder.
pub fn page(results: &[CaseResult]) -> String {
    let wrong = results.iter().filter(|result| !result.holds()).count();
    let all = results.len();
    let mut text = format!(
        "# Where radiosity by rays fails\n\n\
         Made by `virtwall stability`, from the cases in `experiments/stability`. {} of {all} cases are as they\n\
         should be. Naive methods are run too, on the same scenes: up to 200,000 rays where they cast any.\n\n\
         ![How wrong naive methods are, and ours](stability.svg)\n",
        all - wrong
    );
    for listed in Listed::ALL {
        let of = || results.iter().filter(move |result| result.case.listed == listed);
        let _ = write!(text, "\n## {}\n\n", listed.heading());
        text += "| failure | a naive method | ours | right |\n|---|---|---|---|\n";
        of().for_each(|result| text += &row(result));
    }
    text
}

fn row(result: &CaseResult) -> String {
    let case = &result.case;
    let each = |of: &dyn Fn(&Finding) -> String| joined(result.findings.iter().map(of), "<br>");
    let set = || format!("`{}`", settings(&case.naive_settings, "")).replace("``", "");
    let how = case.naive.map_or_else(set, |method| method.words().to_owned());
    let naive = each(&|finding| {
        let naive = finding.naive.as_ref();
        naive.map_or(String::new(), |quantity| described(finding.measure, quantity))
    });
    let ours = each(&|finding| {
        let mark = if finding.holds { "" } else { "**wrong** " };
        format!("{mark}{}", described(finding.measure, &finding.ours))
    });
    let cells = [
        format!("**{}** (`{}`). {}", case.title, result.name, case.failure),
        joined([how, naive], ": "),
        format!("{ours}<br>{}", case.remedy),
        each(&bound),
    ];
    let cells = cells.map(|cell| cell.replace('|', "\\|").replace('\n', " "));
    format!("| {} |\n", cells.join(" | "))
}

/// The parts that are not empty.
fn joined(parts: impl IntoIterator<Item = String>, separator: &str) -> String {
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join(separator)
}

/// Fields and their values in the form that `--set` takes.
fn settings(fields: &Overlay, path: &str) -> String {
    let field = |(name, value): (&String, &Value)| match value {
        Value::Object(fields) => settings(fields, &format!("{path}{name}.")),
        Value::String(text) => format!("{path}{name}={text}"),
        value => format!("{path}{name}={value}"),
    };
    fields.iter().map(field).collect::<Vec<_>>().join(", ")
}

/// A quantity with its unit in words.
fn described(measure: &str, quantity: &Quantity) -> String {
    match quantity {
        Quantity::Count(Count { wrong, of }) => {
            let what = match measure {
                "leaks" => "rays lost",
                "owners" => "rays lost or claimed twice",
                "dark" => "patches in the dark",
                "torn" => "rays torn",
                _ => "rays astray",
            };
            format!("{} of {} {what}", thousands(*wrong), thousands(*of))
        }
        Quantity::Number(number) => format!("{} {}", name(measure), short(*number)),
        Quantity::Whole(number) => format!("{} {}", thousands(*number), name(measure)),
        Quantity::Words(words) => words.clone(),
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
        Quantity::Count(Count { wrong, .. }) => thousands(*wrong),
        Quantity::Number(number) => format!("≤ {}", short(*number)),
        Quantity::Whole(number) => thousands(*number),
        Quantity::Words(words) => format!("“{words}”"),
    }
}

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
