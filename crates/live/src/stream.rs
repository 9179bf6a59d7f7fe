//! A viewer's stream of updates, as server-sent events.

use std::io::{self, BufWriter, Write};
use std::time::Duration;

use crate::board::Board;
use crate::reader::{Event, Reader};

/// Without events a comment is sent after this time, to keep the connection open.
const KEEP_ALIVE: Duration = Duration::from_secs(15);

/// Writes the board's events to a viewer that was added to it, until all runs have ended or the viewer is
/// gone, as fast as the viewer reads.
pub(crate) fn write(board: &Board, only: Option<usize>, to: impl Write) -> io::Result<()> {
    let written = write_events(board, only, &mut BufWriter::new(to));
    board.update(|state| {
        state.viewers -= 1;
        state.fetching += usize::from(matches!(written, Ok(true)));
    });
    written.map(|_| ())
}

/// Writes events until the end; returns whether the viewer received that of the end.
fn write_events(board: &Board, only: Option<usize>, to: &mut dyn Write) -> io::Result<bool> {
    to.write_all(b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n")?;
    to.write_all(b"Connection: close\r\nCache-Control: no-store\r\n")?;
    to.write_all(b"Transfer-Encoding: chunked\r\n\r\n")?;
    to.flush()?;
    let mut reader = Reader::new(only);
    loop {
        let events = board.wait_for(KEEP_ALIVE, |state| reader.read(state)).unwrap_or_default();
        if events.is_empty() {
            write_chunk(to, &[":\n\n"])?;
        }
        for event in &events {
            write_event(to, event)?;
        }
        to.flush()?;
        if events.contains(&Event::Finished) {
            write_chunk(to, &[])?;
            to.flush()?;
            return Ok(true);
        }
    }
}

/// Writes an event as a chunk. A part, which may be long, is not copied.
fn write_event(to: &mut dyn Write, event: &Event) -> io::Result<()> {
    let number;
    let (name, data) = match event {
        Event::Part(part) => ("part", &**part),
        Event::Finished => ("finished", ""),
        Event::Runs { ended, under_way } => {
            number = format!("{{\"ended\":{ended},\"under_way\":{under_way:?}}}");
            ("runs", &*number)
        }
        Event::Begin(run) | Event::Cut(run) | Event::End(run) => {
            number = run.to_string();
            let name = match event {
                Event::Begin(_) => "begin",
                Event::Cut(_) => "cut",
                _ => "end",
            };
            (name, &*number)
        }
    };
    write_chunk(to, &["event: ", name, "\ndata: ", data, "\n\n"])
}

fn write_chunk(to: &mut dyn Write, texts: &[&str]) -> io::Result<()> {
    write!(to, "{:x}\r\n", texts.iter().map(|text| text.len()).sum::<usize>())?;
    texts.iter().try_for_each(|text| to.write_all(text.as_bytes()))?;
    to.write_all(b"\r\n")
}
