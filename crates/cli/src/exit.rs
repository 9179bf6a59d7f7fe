//! Exit codes, and what is printed where.

use std::collections::BTreeSet;
use std::error::Error;
use std::io::{self, Write};

use config::{Fault, shortened};

/// How a command failed.
pub struct Exit {
    pub code: u8,
    /// What is printed to standard output all the same.
    pub output: String,
    pub message: String,
}

impl Exit {
    /// A failure that is not the input's fault.
    pub fn failure(message: impl Into<Box<dyn Error>>) -> Exit {
        Exit { code: 1, output: String::new(), message: message.into().to_string() }
    }

    pub fn bad_input(message: impl Into<Box<dyn Error>>) -> Exit {
        Exit { code: 2, output: String::new(), message: message.into().to_string() }
    }
}

impl From<Fault> for Exit {
    fn from(fault: Fault) -> Exit {
        Exit::bad_input(fault)
    }
}

/// Prints to standard output.
pub fn print(text: &str) -> Result<(), Exit> {
    printed(io::stdout().lock().write_all(text.as_bytes()))
}

/// What was written to standard output has arrived there. That the reader has closed it, as `head` does, is
/// no error.
pub fn printed(written: io::Result<()>) -> Result<(), Exit> {
    match written.and_then(|()| io::stdout().lock().flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Exit::failure(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints the warnings about scenes to standard error, each once.
pub fn print_warnings<'a>(warnings: impl IntoIterator<Item = &'a String>) {
    let mut printed = BTreeSet::new();
    for warning in warnings.into_iter().filter(|&warning| printed.insert(warning)) {
        print_note(&format!("warning: {warning}"));
    }
}

/// Prints a line to standard error, with long names shortened.
pub fn print_note(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", shortened(line));
}
