//! `virtwall explain`: what a column, a field, a choice or a network model is.

use clap::Args;
use lab::{Entry, explain};

use crate::exit::Exit;
use crate::named::kinds_of;

#[derive(Args)]
pub struct Arguments {
    /// A column of runs.csv such as time_s, a field such as stop.patch_threshold, a choice such as C12, or a
    /// network model such as loggp
    word: String,
}

/// Width of the text, letters.
const WIDTH: usize = 96;

/// Explains the word, in each of its meanings.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let word = &arguments.word;
    match explain(word) {
        Ok(entries) => Ok(entries.iter().map(text).collect::<Vec<_>>().join("\n")),
        Err(nearest) => Err(Exit::bad_input(unknown(word, &nearest))),
    }
}

fn unknown(word: &str, nearest: &[String]) -> String {
    if let Some(kind) = kinds_of(word).first() {
        return format!("\"{word}\" is {kind}; to see it: virtwall show {word}");
    }
    let near: Vec<String> = nearest.iter().map(|name| format!("\"{name}\"")).collect();
    let hint = match &near[..] {
        [] => String::new(),
        [one] => format!(", did you mean {one}?"),
        [others @ .., last] => format!(", did you mean {} or {last}?", others.join(", ")),
    };
    format!(
        "unknown word \"{word}\"{hint} (virtwall list prints all columns, fields and choices; fields \
         are dotted paths, such as stop.patch_threshold)"
    )
}

fn text(entry: &Entry) -> String {
    let mut text = format!("{}: {}\n", entry.name, entry.term);
    text += &paragraph("  ", &entry.about);
    let places = entry.places();
    let paper = if places.is_empty() { "not mentioned".to_owned() } else { places.join(", ") };
    for (name, value) in entry.facts.iter().chain([&("paper", paper)]) {
        text += &paragraph(&format!("  {name:<9}"), value);
    }
    text
}

/// A text in lines; the first begins with `head`, others are indented as far.
fn paragraph(head: &str, text: &str) -> String {
    let indent = head.chars().count();
    let (mut lines, mut line) = (String::new(), head.to_owned());
    let mut column = indent;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if column > indent && column + 1 + length > WIDTH {
            lines += &format!("{}\n", line.trim_end());
            (line, column) = (" ".repeat(indent), indent);
        }
        if column > indent {
            line.push(' ');
            column += 1;
        }
        line += word;
        column += length;
    }
    lines + line.trim_end() + "\n"
}
