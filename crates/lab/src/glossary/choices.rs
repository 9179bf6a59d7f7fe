//! The choices that the code makes where the paper is silent. Their list is in crates/README.md.

use crate::glossary::entry::{Entry, Term};

const PAGE: &str = include_str!("../../../README.md");

/// All choices, each named by its number, such as "C12".
pub fn choices() -> Vec<Entry> {
    let rows = PAGE.lines().skip_while(|line| !line.starts_with("| choice |")).skip(2);
    rows.map_while(choice).collect()
}

/// A row: number and subject, field, default, and what another choice moves.
fn choice(row: &str) -> Option<Entry> {
    let cells: Vec<&str> = row.strip_prefix('|')?.split('|').map(str::trim).collect();
    let [subject, field, default, moves, ..] = cells[..] else { return None };
    let (number, subject) = subject.split_once(' ')?;
    let (mut letters, mut about) = (subject.chars(), String::new());
    about.extend(letters.next().into_iter().flat_map(char::to_uppercase));
    about = about + letters.as_str() + ".";
    let text = |cell: &str| without_links(&cell.replace('`', ""));
    let fixed = field == "–";
    let entry = Entry::new(Term::Choice, number, &text(&about));
    let entry =
        entry.with("field", if fixed { "none: it is fixed".to_owned() } else { text(field) });
    Some(
        entry
            .with(if fixed { "choice" } else { "default" }, text(default))
            .with("moves", text(moves)),
    )
}

/// The text without the addresses of its links.
fn without_links(text: &str) -> String {
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().replace('[', "");
    parts.fold(first, |all, part| {
        all + &part.split_once(')').map_or(part, |(_, rest)| rest).replace('[', "")
    })
}
