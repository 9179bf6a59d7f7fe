//! Claims: what a README says that results say. A comment above a table names a file and how each row
//! follows from it; a comment below a paragraph does so for its phrases. CONTRIBUTING.md explains how to
//! write one.
//!
//! ```text
//! <!-- from results/paging/runs.csv
//! for processors = 1, 2, 4:
//! | {processors} | {time_s[node_memory.available=8.5 MiB] : .2} |
//! the least takes {min(time_s) : .1} s
//! -->
//! ```

use crate::expression;
use crate::source::Sources;

/// Variables of a `for` line and their values: `processors` and `56`.
pub type Variables = Vec<(String, String)>;

/// What one comment claims.
pub struct Claims {
    /// Cells of the rows that the table below the comment must have.
    pub rows: Vec<Vec<String>>,
    /// Phrases that the document must hold.
    pub phrases: Vec<String>,
}

/// Cells of a row of a table.
pub fn cells(line: &str) -> Vec<String> {
    line.trim().trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
}

/// Computes what the text of a comment, after `<!-- from`, claims.
pub fn compute(comment: &str, sources: &mut Sources) -> Result<Claims, String> {
    let mut lines = comment.lines().map(str::trim).filter(|line| !line.is_empty());
    let file = lines.next().unwrap_or_default();
    let mut loops = vec![Variables::new()];
    let mut claims = Claims { rows: Vec::new(), phrases: Vec::new() };
    for line in lines {
        if let Some(variables) = line.strip_prefix("for ") {
            loops = combinations(variables.trim_end_matches(':'));
            continue;
        }
        for variables in &loops {
            let text =
                fill(line, file, variables, sources).map_err(|why| format!("{line}: {why}"))?;
            match text.starts_with('|') {
                true => claims.rows.push(cells(&text)),
                false => claims.phrases.push(text),
            }
        }
    }
    Ok(claims)
}

/// All combinations of the values in `a = 1, 2; b = x, y`, the last variable running fastest.
fn combinations(text: &str) -> Vec<Variables> {
    let mut found = vec![Variables::new()];
    for variable in text.split(';') {
        let (name, values) = variable.split_once('=').unwrap_or((variable, ""));
        let longer = |before: &Variables| {
            let values =
                values.split(',').map(|value| (name.trim().to_owned(), value.trim().to_owned()));
            values.map(|value| [before.as_slice(), &[value]].concat()).collect::<Vec<_>>()
        };
        found = found.iter().flat_map(longer).collect();
    }
    found
}

/// Repeats what is in `<< a = 1, 2: ... >>`, and replaces each `{expression : format}`.
fn fill(
    line: &str,
    file: &str,
    variables: &Variables,
    sources: &mut Sources,
) -> Result<String, String> {
    if let Some((before, rest)) = line.split_once("<<") {
        let (inner, after) = rest.split_once(">>").ok_or("a << without a >>")?;
        let (loops, repeated) = inner.split_once(':').ok_or("a << without a :")?;
        let mut text = fill(before, file, variables, sources)?;
        for more in combinations(loops) {
            text += &fill(repeated, file, &[variables.as_slice(), &more].concat(), sources)?;
        }
        return Ok(text + &fill(after, file, variables, sources)?);
    }
    let mut text = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once('{') {
        let (hole, after) = after.split_once('}').ok_or("a { without a }")?;
        text += before;
        text += &value(hole, file, variables, sources)?;
        rest = after;
    }
    Ok(text + rest)
}

fn value(
    hole: &str,
    file: &str,
    variables: &Variables,
    sources: &mut Sources,
) -> Result<String, String> {
    let (text, format) = hole.rsplit_once(" : ").unwrap_or((hole, ""));
    if let Some((_, value)) = variables.iter().find(|(name, _)| name == text.trim()) {
        return match format {
            "" => Ok(value.clone()),
            _ => formatted(expression::number(value)?, format.trim()),
        };
    }
    let found = expression::evaluate(text, file, variables, sources)?;
    match format {
        "" => found.text(),
        _ => formatted(found.number()?, format.trim()),
    }
}

/// `.2` decimals; `%1` per cent with one decimal; `,` whole, by thousands.
fn formatted(value: f64, format: &str) -> Result<String, String> {
    let (kind, digits) = format.split_at(1);
    let decimals = digits.parse().unwrap_or(0);
    Ok(match kind {
        "." => format!("{value:.decimals$}"),
        "%" => format!("{:.decimals$} %", 100.0 * value),
        "," => by_thousands(&format!("{value:.0}")),
        _ => return Err(format!("no format: {format}")),
    })
}

/// Puts a comma before each group of three digits.
fn by_thousands(digits: &str) -> String {
    let comma = |at: usize| at > 0 && (digits.len() - at).is_multiple_of(3);
    let parts = digits.chars().enumerate();
    parts.flat_map(|(at, digit)| comma(at).then_some(',').into_iter().chain([digit])).collect()
}
