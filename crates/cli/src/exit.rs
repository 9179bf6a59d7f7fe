//! How a command ends, and what it says.

use std::error::Error;
use std::io::{self, Write};

use lab::Fault;

/// A command that did not do what it was asked.
pub struct Exit {
    /// The process's exit code.
    pub code: u8,
    /// What goes to standard output nevertheless.
    pub output: String,
    /// What went wrong.
    pub message: String,
}

impl Exit {
    /// Something failed that the input is not to blame for.
    pub fn failure(message: impl Into<Box<dyn Error>>) -> Exit {
        Exit { code: 1, output: String::new(), message: message.into().to_string() }
    }

    /// Bad input.
    pub fn bad_input(message: impl Into<Box<dyn Error>>) -> Exit {
        Exit { code: 2, output: String::new(), message: message.into().to_string() }
    }
}

impl From<Fault> for Exit {
    fn from(fault: Fault) -> Exit {
        Exit::bad_input(fault)
    }
}

/// Prints to standard output. A reader that has gone, as `head` does, is no reason to complain.
pub fn say(text: &str) {
    let mut output = io::stdout().lock();
    let _ = output.write_all(text.as_bytes()).and_then(|()| output.flush());
}

/// Prints a line to standard error.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Prints what went wrong to standard error.
pub fn complain(message: &str) {
    note(&format!("error: {message}"));
}
