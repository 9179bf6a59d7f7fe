//! A harness for another library: compiled from C++ source in this crate, then driven line by line.

use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::str::FromStr;

/// How to build a program.
pub struct Recipe {
    pub name: &'static str,
    pub source: &'static str,
    /// The library that it is linked with.
    pub library: &'static str,
    /// Debian packages that it needs.
    pub packages: &'static str,
}

impl Recipe {
    /// Compiles the program into the folder of the running one.
    pub fn build(&self) -> Result<Program, String> {
        let Recipe { name, source, library, packages } = self;
        let own = std::env::current_exe().map_err(|error| format!("{name}: {error}"))?;
        let program = own.with_file_name(format!("peers-{name}"));
        let missing =
            |why: &str| format!("{name}: {why}\nTo install it on Debian: apt install {packages}");
        let mut compiler = Command::new("c++")
            .args(["-std=c++17", "-O3", "-march=native", "-x", "c++", "-", "-o"])
            .arg(&program)
            .arg(format!("-l{library}"))
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| missing(&format!("the compiler c++ does not start: {error}")))?;
        if let Some(mut input) = compiler.stdin.take() {
            // If the compiler stops reading, its standard error has the reason.
            let _ = input.write_all(source.as_bytes());
        }
        let output = compiler.wait_with_output().map_err(|error| missing(&error.to_string()))?;
        if output.status.success() {
            return Ok(Program { name, path: program });
        }
        let errors = String::from_utf8_lossy(&output.stderr);
        let first = errors.lines().find(|line| line.contains("error"));
        Err(missing(first.unwrap_or("the compiler c++ failed")))
    }
}

pub struct Program {
    name: &'static str,
    path: PathBuf,
}

/// A running program that answers line by line.
pub struct Peer {
    name: &'static str,
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Peer {
    pub fn start(program: &Program, arguments: &[&str]) -> Result<Peer, String> {
        let Program { name, path } = program;
        let mut child = Command::new(path)
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{}: {error}", path.display()))?;
        let pipes = child.stdin.take().zip(child.stdout.take());
        let (input, output) = pipes.ok_or_else(|| format!("{name}: no pipes"))?;
        Ok(Peer { name, child, input, output: BufReader::new(output) })
    }

    pub fn write(&mut self, text: &str) -> Result<(), String> {
        let written = self.input.write_all(text.as_bytes()).and_then(|()| self.input.flush());
        written.map_err(|error| format!("{}: {error}", self.name))
    }

    /// The next line of its output.
    pub fn line(&mut self) -> Result<String, String> {
        let mut line = String::new();
        match self.output.read_line(&mut line) {
            Ok(read) if read > 0 => Ok(line.trim().to_owned()),
            Ok(_) => Err(format!("{}: it ended too early", self.name)),
            Err(error) => Err(format!("{}: {error}", self.name)),
        }
    }

    /// The next line of its output: seconds, a count, and one more value.
    pub fn figures<T: FromStr>(&mut self) -> Result<(f64, u64, T), String> {
        let line = self.line()?;
        let mut words = line.split(' ');
        let mut next = || words.next().unwrap_or_default();
        let (seconds, count, more) = (next().parse(), next().parse(), next().parse());
        match (seconds, count, more) {
            (Ok(seconds), Ok(count), Ok(more)) => Ok((seconds, count, more)),
            _ => Err(format!("{}: found \"{line}\"; expected three numbers", self.name)),
        }
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // Errors do not matter: its output is no longer needed.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Passes with and without a compiler on the host.
    #[test]
    fn errors_name_the_missing_package() {
        let recipe = Recipe {
            name: "nothing",
            source: "#error \"Nothing is not installed\"",
            library: "nothing",
            packages: "g++ libnothing-dev",
        };
        let message = recipe.build().err().unwrap();
        assert!(message.starts_with("nothing: "), "{message}");
        assert!(message.ends_with("apt install g++ libnothing-dev"), "{message}");
    }
}
