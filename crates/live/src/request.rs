//! Reading a request: its line and headers, with limits on bytes and time.

use std::io::ErrorKind;
use std::net::TcpStream;
use std::time::Duration;

use crate::deadline::Deadline;

/// The most bytes of a request's line and headers. Browsers send about 1 KB.
const MOST_BYTES: usize = 16 << 10;
/// The most headers.
const MOST_HEADERS: usize = 100;
/// The most time from the connection to the end of its request's headers.
const MOST_TIME: Duration = Duration::from_secs(5);

/// A request without its body, which no answer needs.
pub(crate) struct Request {
    pub method: String,
    /// Path and query.
    pub url: String,
    /// The values of all `Host` headers.
    pub hosts: Vec<String>,
}

/// Why a connection has no request that can be answered.
pub(crate) enum NoRequest {
    /// The client has closed it, or it failed.
    Gone,
    /// To be answered with this status.
    Refused(u16, &'static str),
}

/// Reads the request of a new connection.
pub(crate) fn read(stream: &TcpStream) -> Result<Request, NoRequest> {
    let deadline = Deadline::after(MOST_TIME);
    let mut bytes = vec![0; MOST_BYTES];
    let mut filled = 0;
    while filled < MOST_BYTES {
        filled += match deadline.read(stream, &mut bytes[filled..]) {
            Ok(read @ 1..) => read,
            Err(error) if error.kind() == ErrorKind::TimedOut => {
                return Err(NoRequest::Refused(408, "the request took too long"));
            }
            _ => return Err(NoRequest::Gone),
        };
        if let Some(request) = parse(&bytes[..filled])? {
            return Ok(request);
        }
    }
    Err(TOO_LARGE)
}

const TOO_LARGE: NoRequest = NoRequest::Refused(431, "expected at most 16 KiB and 100 headers");

/// The request; `None` while its end has not arrived.
fn parse(bytes: &[u8]) -> Result<Option<Request>, NoRequest> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    match request.parse(bytes) {
        Ok(httparse::Status::Complete(_)) => {}
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(httparse::Error::TooManyHeaders) => return Err(TOO_LARGE),
        Err(_) => return Err(NoRequest::Refused(400, "expected an HTTP/1 request")),
    }
    let hosts = request.headers.iter().filter(|header| header.name.eq_ignore_ascii_case("Host"));
    let hosts = hosts.map(|header| String::from_utf8_lossy(header.value).into_owned()).collect();
    let owned = |text: Option<&str>| text.unwrap_or_default().to_owned();
    Ok(Some(Request { method: owned(request.method), url: owned(request.path), hosts }))
}
