//! Bad input: one message that names file, place and value and says what was expected.

use std::fmt;

use crate::files::place::Place;

/// Why an input is refused. Its text is one message, complete in itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The file, as the user named it, or the argument at fault; empty if the message names it.
    pub file: String,
    /// The line in the file, from 1.
    pub line: Option<usize>,
    /// The value in the file; empty when the fault is the file's as a whole.
    pub place: Place,
    /// What is wrong and what was expected.
    pub message: String,
}

impl Fault {
    /// A fault of a file as a whole.
    pub fn of_file(file: impl fmt::Display, message: impl Into<String>) -> Fault {
        let (file, message) = (file.to_string(), message.into());
        Fault { file, line: None, place: Place::default(), message }
    }

    /// A fault whose message already names file and place.
    pub fn complete(message: impl fmt::Display) -> Fault {
        let message = message.to_string();
        Fault { file: String::new(), line: None, place: Place::default(), message }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.file.is_empty() {
            return f.write_str(&self.message);
        }
        write!(f, "{}", self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if !self.place.0.is_empty() {
            write!(f, ": {}", self.place)?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for Fault {}

/// The message for a name that is not among those known: the nearest one, then all.
pub fn unknown(what: &str, name: &str, known: &[String]) -> String {
    let nearest = known
        .iter()
        .map(|candidate| (strsim::damerau_levenshtein(name, candidate), candidate))
        .filter(|(distance, _)| *distance <= 1 + name.chars().count() / 4)
        .min();
    let hint = nearest.map_or(String::new(), |(_, near)| format!(", did you mean \"{near}\"?"));
    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    format!("unknown {what} \"{name}\"{hint} (there are: {known})")
}

/// What is wrong with a field of the experiment: its place, and the message.
pub type WrongField = (&'static str, String);
