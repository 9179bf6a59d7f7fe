//! Reads from a connection until a deadline, however slowly bytes arrive.

use std::io::{self, ErrorKind, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

#[derive(Clone, Copy)]
pub(crate) struct Deadline(Instant);

impl Deadline {
    pub fn after(span: Duration) -> Deadline {
        Deadline(now() + span)
    }

    /// Reads some bytes; none at the end of the connection.
    ///
    /// # Errors
    /// [`ErrorKind::TimedOut`] at the deadline; others of the connection.
    pub fn read(self, mut stream: &TcpStream, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let left = self.0.saturating_duration_since(now());
            if left.is_zero() {
                return Err(ErrorKind::TimedOut.into());
            }
            stream.set_read_timeout(Some(left))?;
            match stream.read(buffer) {
                Err(error) if is_wait(error.kind()) => {}
                read => return read,
            }
        }
    }
}

fn is_wait(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted)
}

#[expect(clippy::disallowed_methods, reason = "a connection's time is the host's")]
fn now() -> Instant {
    Instant::now()
}
