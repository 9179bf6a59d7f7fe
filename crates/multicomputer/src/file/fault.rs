//! What is wrong with a file, and where.

use std::fmt;

use serde::de::DeserializeOwned;

/// What is wrong with a machine file or a trace, and where.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MachineFault {
    /// The file.
    pub file: String,
    /// Line and column, from 1; `None` where the fault lies in several places.
    pub line_and_column: Option<(usize, usize)>,
    /// The way to the value, such as `processor.clock.value`; empty for the file as a whole.
    pub place: String,
    /// What was found and what was expected.
    pub message: String,
}

impl MachineFault {
    /// A fault of a file that is yet to be named.
    pub(crate) fn at(place: impl Into<String>, message: impl Into<String>) -> MachineFault {
        let (place, message) = (place.into(), message.into());
        MachineFault { place, message, ..MachineFault::default() }
    }
}

impl fmt::Display for MachineFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some((line, column)) = self.line_and_column {
            write!(f, ":{line}:{column}")?;
        }
        if !self.place.is_empty() {
            write!(f, ": {}", self.place)?;
        }
        write!(f, ": {}", self.message)
    }
}

/// A file's text as its raw structure, or serde's complaint and its place.
pub(crate) fn read<T: DeserializeOwned>(text: &str) -> Result<T, MachineFault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let file = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let place = error.path().to_string();
        fault(if place == "." { String::new() } else { place }, error.inner())
    })?;
    json.end().map_err(|error| fault(String::new(), &error))?;
    Ok(file)
}

fn fault(place: String, error: &serde_json::Error) -> MachineFault {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    // serde_json appends the position to its message; it is told apart here.
    let suffix = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&suffix).unwrap_or(&message);
    // Without Rust's names of types.
    let message = message.replace("expected u64", "expected a whole number, 0 or more");
    let message = message.replace("expected a sequence", "expected a list");
    let line_and_column = (line > 0).then_some((line, column));
    MachineFault { file: String::new(), line_and_column, place, message }
}

impl std::error::Error for MachineFault {}
