//! GOAL schedules, the text form that LogGOPSim's txt2bin reads.
//!
//! Hoefler, Siebert, Lumsdaine: Group Operation Assembly Language, ICPP 2009.
//!
//! ```text
//! num_ranks 2
//! rank 0 {
//!   l1: calc 100            // nanoseconds
//!   l2: send 8b to 1 tag 5
//!   l2 requires l1
//! }
//! rank 1 { l1: recv 8b from 0 tag 5 }
//! ```
//!
//! Refused, since a node here has one processor and one port, and reads messages by sender and tag: other
//! numbers of `cpu` and `nic` than 0, any source or tag (-1), and `irequires`.

use std::collections::BTreeMap;

use config::Fault;
use desim::Duration;

use super::schedule::{Operation, OperationKind, Schedule};
use super::trace::MOST_BYTES;

/// Longest computation, nanoseconds: a day.
const MOST_NANOSECONDS: u64 = 86_400_000_000_000;

impl Schedule {
    /// Reads a GOAL schedule's text, for a machine of `nodes` nodes; `file_name` is for messages only.
    ///
    /// # Errors
    /// [`Fault`], with file, line, what was found and what was expected.
    pub fn from_goal(text: &str, file_name: &str, nodes: usize) -> Result<Schedule, Fault> {
        let fault = |(line, message): Wrong| Fault {
            line: Some(line),
            ..Fault::of_file(file_name, message)
        };
        let tokens = tokens(text).map_err(fault)?;
        let mut reader = Reader { tokens: &tokens, next: 0, nodes, ..Reader::default() };
        reader.schedule().map_err(fault)?;
        reader.matches().map_err(fault)?;
        Ok(reader.schedule)
    }
}

/// A line and what is wrong there.
type Wrong = (usize, String);

struct Token<'a> {
    line: usize,
    text: &'a str,
}

/// Words, numbers and signs, without comments.
fn tokens(text: &str) -> Result<Vec<Token<'_>>, Wrong> {
    let mut tokens = Vec::new();
    let mut comment = None;
    for (number, line) in text.lines().enumerate() {
        let (number, mut rest) = (number + 1, line);
        while !rest.is_empty() {
            if comment.is_some() {
                let Some((_, after)) = rest.split_once("*/") else { break };
                (rest, comment) = (after, None);
            } else if rest.starts_with("//") {
                break;
            } else if let Some(after) = rest.strip_prefix("/*") {
                (rest, comment) = (after, Some(number));
            } else {
                let word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
                let first = rest.chars().next().map_or(0, char::len_utf8);
                let end = rest.find(|c| !word(c)).unwrap_or(rest.len()).max(first);
                let (token, after) = rest.split_at(end);
                if !token.trim().is_empty() && token != ";" {
                    tokens.push(Token { line: number, text: token });
                }
                rest = after;
            }
        }
    }
    match comment {
        None => Ok(tokens),
        Some(line) => Err((line, "found a comment without end; expected \"*/\"".to_owned())),
    }
}

#[derive(Default)]
struct Reader<'a> {
    tokens: &'a [Token<'a>],
    next: usize,
    /// Nodes of the machine, and ranks of the schedule once they are known.
    nodes: usize,
    ranks: usize,
    schedule: Schedule,
    /// The line of each operation.
    lines: Vec<usize>,
    /// The line of each rank's schedule.
    began: BTreeMap<usize, usize>,
}

impl<'a> Reader<'a> {
    fn peek(&self) -> Option<&'a str> {
        self.tokens.get(self.next).map(|token| token.text)
    }

    /// The line of the next token, or the last one.
    fn line(&self) -> usize {
        let token = self.tokens.get(self.next).or(self.tokens.last());
        token.map_or(1, |token| token.line)
    }

    /// What is wrong with the next token.
    fn wrong<T>(&self, expected: &str) -> Result<T, Wrong> {
        let found = self.peek().map_or("the end".to_owned(), |text| format!("\"{text}\""));
        Err((self.line(), format!("found {found}; expected {expected}")))
    }

    /// Takes the next token if it is this one.
    fn take(&mut self, text: &str) -> bool {
        let found = self.peek() == Some(text);
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, text: &str) -> Result<(), Wrong> {
        if self.take(text) { Ok(()) } else { self.wrong(&format!("\"{text}\"")) }
    }

    fn number(&mut self, what: &str, most: u64) -> Result<u64, Wrong> {
        let number = self.peek().and_then(|text| text.parse().ok());
        match number.filter(|&number: &u64| number <= most) {
            Some(number) => {
                self.next += 1;
                Ok(number)
            }
            None => self.wrong(&format!("{what}, a whole number, at most {most}")),
        }
    }

    fn schedule(&mut self) -> Result<(), Wrong> {
        self.expect("num_ranks")?;
        let nodes = self.nodes as u64;
        self.ranks =
            self.number("the number of ranks; the machine has that many nodes", nodes)? as usize;
        if self.ranks == 0 {
            self.next -= 1;
            return self.wrong("1 or more");
        }
        while self.peek().is_some() {
            let line = self.line();
            self.expect("rank")?;
            let rank = self.rank()?;
            if let Some(first) = self.began.insert(rank, line) {
                return Err((
                    line,
                    format!("found rank {rank} again, which begins in line {first}"),
                ));
            }
            self.expect("{")?;
            self.rank_operations(rank)?;
        }
        Ok(())
    }

    fn rank(&mut self) -> Result<usize, Wrong> {
        let most = self.ranks as u64 - 1;
        Ok(self.number("a rank", most)? as usize)
    }

    /// The operations of a rank, and which of them wait for which.
    fn rank_operations(&mut self, rank: usize) -> Result<(), Wrong> {
        let mut labels = BTreeMap::new();
        while !self.take("}") {
            let line = self.line();
            let Some(word) = self.peek() else { return self.wrong("\"}\"") };
            let mut label = None;
            if !matches!(word, "calc" | "send" | "recv") {
                if !word.starts_with(|c: char| c.is_ascii_alphabetic()) {
                    return self.wrong("calc, send, recv, a label or \"}\"");
                }
                self.next += 1;
                if !self.take(":") {
                    self.dependency(word, &labels)?;
                    continue;
                }
                label = Some(word);
                if labels.insert(word, self.schedule.operations.len()).is_some() {
                    return Err((
                        line,
                        format!("found the label \"{word}\" twice; expected it once"),
                    ));
                }
            }
            let kind = self.operation()?;
            let number = self.schedule.operations.len();
            let name = match label {
                None => format!("{rank}.{number}"),
                Some(label) => format!("{rank}.{label}"),
            };
            self.schedule.operations.push(Operation { name, node: rank, kind, after: Vec::new() });
            self.lines.push(line);
        }
        Ok(())
    }

    /// The rest of `a requires b`.
    fn dependency(&mut self, later: &str, labels: &BTreeMap<&str, usize>) -> Result<(), Wrong> {
        if self.peek() == Some("irequires") {
            return self.wrong("\"requires\": an operation begins only when others have ended");
        }
        if !self.take("requires") {
            return self.wrong("\":\" or \"requires\"");
        }
        let find = |name: &str| labels.get(name).copied();
        let Some(later_index) = find(later) else {
            let message =
                format!("found \"{later}\"; expected a label that stands above in this rank");
            return Err((self.line(), message));
        };
        let Some(earlier) = self.peek().and_then(find) else {
            return self.wrong("a label that stands above in this rank");
        };
        self.next += 1;
        let after = &mut self.schedule.operations[later_index].after;
        if !after.contains(&earlier) {
            after.push(earlier);
        }
        Ok(())
    }

    fn operation(&mut self) -> Result<OperationKind, Wrong> {
        if self.take("calc") {
            let span = self.number("nanoseconds", MOST_NANOSECONDS)?;
            self.only("cpu")?;
            return Ok(OperationKind::Compute(Duration(span * 1_000)));
        }
        let send = self.take("send");
        if !send && !self.take("recv") {
            return self.wrong("calc, send or recv");
        }
        let bytes = self.bytes()?;
        self.expect(if send { "to" } else { "from" })?;
        let partner = self.rank()?;
        let tag = match self.take("tag") {
            true => self.number("a tag", u64::from(u32::MAX) - 1)? as u32,
            false => 0,
        };
        self.only("cpu")?;
        self.only("nic")?;
        Ok(match send {
            true => OperationKind::Send { to: partner, bytes, tag },
            false => OperationKind::Receive { from: partner, tag },
        })
    }

    /// "8b" or "8 b".
    fn bytes(&mut self) -> Result<u64, Wrong> {
        let text = self.peek().unwrap_or_default();
        let digits = text.strip_suffix('b').unwrap_or(text);
        match digits.parse().ok().filter(|&bytes: &u64| bytes <= MOST_BYTES) {
            Some(bytes) => {
                self.next += 1;
                if digits == text {
                    self.expect("b")?;
                }
                Ok(bytes)
            }
            None => self.wrong(&format!("bytes such as \"8b\", at most {MOST_BYTES}")),
        }
    }

    /// An optional number of a processor or a port, of which a node has one.
    fn only(&mut self, what: &str) -> Result<(), Wrong> {
        if self.take(what) {
            self.number(&format!("0, the only {what} of a node"), 0)?;
        }
        Ok(())
    }

    /// Whether each message that is sent is received.
    fn matches(&self) -> Result<(), Wrong> {
        let mut counts: BTreeMap<_, ([usize; 2], usize)> = BTreeMap::new();
        for (operation, &line) in self.schedule.operations.iter().zip(&self.lines) {
            let (key, side) = match operation.kind {
                OperationKind::Compute(_) => continue,
                OperationKind::Send { to, tag, .. } => ((operation.node, to, tag), 0),
                OperationKind::Receive { from, tag } => ((from, operation.node, tag), 1),
            };
            let (count, last) = counts.entry(key).or_default();
            count[side] += 1;
            *last = line;
        }
        match counts.into_iter().find(|(_, (count, _))| count[0] != count[1]) {
            None => Ok(()),
            Some(((from, to, tag), ([sends, receives], line))) => {
                let what = format!("{sends} sends and {receives} receives from {from} to {to}");
                Err((line, format!("found {what} with tag {tag}; expected equally many")))
            }
        }
    }
}
