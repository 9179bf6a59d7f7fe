//! Bad input: one message that names file, line, place and value and says what was expected.

use std::fmt::{self, Write};

use crate::place::Place;
use crate::readable::shortened;

/// Why an input is refused. Its text is one message, complete in itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fault {
    /// The file, as the user named it, or the argument at fault; empty if the message names it, or
    /// if it is not known yet.
    pub file: String,
    /// The line in the file, from 1.
    pub line: Option<usize>,
    /// The column, where the text is not JSON.
    pub column: Option<usize>,
    /// The value in the file; empty when the fault is the file's as a whole.
    pub place: Place,
    /// What was found and what was expected.
    pub message: String,
}

impl Fault {
    /// A fault of a file as a whole.
    pub fn of_file(file: impl fmt::Display, message: impl Into<String>) -> Fault {
        Fault { file: file.to_string(), message: message.into(), ..Fault::default() }
    }

    /// A fault at a place of a file that the caller will name: see [`crate::Document::locate`].
    pub fn at(place: Place, message: impl Into<String>) -> Fault {
        Fault { place, message: message.into(), ..Fault::default() }
    }

    /// A fault whose message already names file and place.
    pub fn complete(message: impl fmt::Display) -> Fault {
        Fault { message: message.to_string(), ..Fault::default() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = self.line.map_or(String::new(), |line| format!(":{line}"));
        let column = self.column.map_or(String::new(), |column| format!(":{column}"));
        let place = self.place.to_string();
        let parts = [self.file.clone() + &line + &column, place, self.message.clone()];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        // Names and values from files may have line ends or control codes of a terminal.
        shortened(&parts.join(": ")).chars().try_for_each(|c| match c.is_control() {
            true => write!(f, "{}", c.escape_default()),
            false => f.write_char(c),
        })
    }
}

impl std::error::Error for Fault {}

/// The number of letters by which a name differs from a known one; none if they are too many for a slip.
pub fn distance(name: &str, known: &str) -> Option<usize> {
    let distance = strsim::damerau_levenshtein(name, known);
    (distance <= 1 + name.chars().count() / 4).then_some(distance)
}

/// The message for a name that is not among those known: the nearest one, then all.
pub fn unknown(what: &str, name: &str, known: &[String]) -> String {
    let nearest =
        known.iter().filter_map(|candidate| Some((distance(name, candidate)?, candidate)));
    let nearest = nearest.min();
    let hint = nearest.map_or(String::new(), |(_, near)| format!(", did you mean \"{near}\"?"));
    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    format!("unknown {what} \"{name}\"{hint} (there are: {known})")
}
