//! A viewer's stream of updates, as server-sent events.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::time::Duration;

use crate::board::Board;
use crate::reader::{Event, Reader};

/// Without events a comment is sent after this time, to keep the connection open.
const KEEP_ALIVE: Duration = Duration::from_secs(15);

/// Writes the board's events until all runs have ended or the viewer is gone, as fast as the viewer
/// reads.
pub(crate) fn write(board: &Board, only: Option<usize>, to: &mut dyn Write) -> io::Result<()> {
    board.update(|state| state.viewers += 1);
    let written = write_events(board, only, to);
    board.update(|state| {
        state.viewers -= 1;
        state.fetching += usize::from(matches!(written, Ok(true)));
    });
    written.map(|_| ())
}

/// Writes events until the end; returns whether the viewer received that of the end.
fn write_events(board: &Board, only: Option<usize>, to: &mut dyn Write) -> io::Result<bool> {
    to.write_all(b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n")?;
    to.write_all(b"Cache-Control: no-store\r\nTransfer-Encoding: chunked\r\n\r\n")?;
    to.flush()?;
    let mut reader = Reader::new(only);
    loop {
        let events = board.wait_for(KEEP_ALIVE, |state| reader.read(state)).unwrap_or_default();
        let text = if events.is_empty() { ":\n\n".to_owned() } else { encode(&events) };
        write!(to, "{:x}\r\n{text}\r\n", text.len())?;
        to.flush()?;
        if events.contains(&Event::Finished) {
            to.write_all(b"0\r\n\r\n")?;
            to.flush()?;
            return Ok(true);
        }
    }
}

fn encode(events: &[Event]) -> String {
    let mut text = String::new();
    for event in events {
        let (name, data) = match event {
            Event::Runs { ended, under_way } => {
                ("runs", format!("{{\"ended\":{ended},\"under_way\":{under_way:?}}}"))
            }
            Event::Begin(run) => ("begin", run.to_string()),
            Event::Part(part) => ("part", part.to_string()),
            Event::Cut(run) => ("cut", run.to_string()),
            Event::End(run) => ("end", run.to_string()),
            Event::Finished => ("finished", String::new()),
        };
        // Writing to a string cannot fail.
        let _ = write!(text, "event: {name}\ndata: {data}\n\n");
    }
    text
}
