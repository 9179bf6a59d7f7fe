//! Writing an answer: status, headers and body. The connection is closed after it.

use std::io::{self, Write};
use std::net::{Shutdown, TcpStream};
use std::time::Duration;

use crate::deadline::Deadline;

/// How long a client's bytes are read and dropped after an answer: closing a connection with unread bytes
/// would reset it, and the client might lose the answer.
const DROPPING: Duration = Duration::from_secs(1);

pub(crate) struct Answer<'a> {
    status: u16,
    headers: &'static [&'static str],
    kind: &'static str,
    body: &'a [u8],
}

/// Headers of everything that is served.
const FILE: &[&str] = &[
    "Cache-Control: no-store",
    "X-Content-Type-Options: nosniff",
    "Cross-Origin-Resource-Policy: same-origin",
];
const PLAIN: &str = "text/plain; charset=utf-8";

impl<'a> Answer<'a> {
    /// What was asked for.
    pub fn file(kind: &'static str, body: &'a [u8]) -> Answer<'a> {
        Answer { status: 200, headers: FILE, kind, body }
    }

    /// Nothing.
    pub fn empty() -> Answer<'a> {
        Answer { status: 204, headers: &[], kind: PLAIN, body: &[] }
    }

    /// Why something is refused.
    pub fn refusal(status: u16, why: &'a str) -> Answer<'a> {
        let headers: &[&str] = match status {
            405 => &["Allow: GET, HEAD"],
            503 => &["Retry-After: 5"],
            _ => &[],
        };
        Answer { status, headers, kind: PLAIN, body: why.as_bytes() }
    }

    /// Writes the answer, without its body if `head_only`.
    pub fn write(&self, mut to: impl Write, head_only: bool) -> io::Result<()> {
        let Answer { status, headers, kind, body } = self;
        let mut head = format!("HTTP/1.1 {status} {}\r\nConnection: close\r\n", reason(*status));
        for header in *headers {
            head += header;
            head += "\r\n";
        }
        head += &format!("Content-Type: {kind}\r\nContent-Length: {}\r\n\r\n", body.len());
        to.write_all(head.as_bytes())?;
        if !head_only {
            to.write_all(body)?;
        }
        to.flush()
    }
}

/// Ends a connection whose answer is written, so that the client receives all of it.
pub(crate) fn close(stream: &TcpStream) -> io::Result<()> {
    stream.shutdown(Shutdown::Write)?;
    let (deadline, mut dropped) = (Deadline::after(DROPPING), [0; 4096]);
    while deadline.read(stream, &mut dropped)? > 0 {}
    Ok(())
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        204 => "No Content",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        408 => "Request Timeout",
        431 => "Request Header Fields Too Large",
        503 => "Service Unavailable",
        _ => "",
    }
}
