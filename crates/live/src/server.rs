//! The server: listens, and answers requests for one page, its files and its stream of events.

use std::io;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use tiny_http::{Header, Method, Request, Response};

use crate::board::Board;
use crate::host::is_ours;
use crate::stream;

/// The most requests that are answered at one time, including streams.
const MOST_REQUESTS: usize = 64;

/// What is served.
pub trait Site: Send + Sync {
    /// The page, as it is now.
    fn page(&self) -> Arc<str>;

    /// The file of this name, if there is one.
    fn file(&self, name: &str) -> Option<String>;
}

/// What the threads that answer requests share.
struct Shared {
    address: IpAddr,
    site: Arc<dyn Site>,
    board: Arc<Board>,
    requests: AtomicUsize,
}

/// Serves a site, and the stream of a board at `/updates`, as long as the process lives. Returns the address;
/// with port 0 the system chooses a port.
///
/// # Errors
/// If the address is not available.
pub fn serve(
    address: SocketAddr,
    site: Arc<dyn Site>,
    board: &Arc<Board>,
) -> io::Result<SocketAddr> {
    let listener = TcpListener::bind(address)?;
    let address = listener.local_addr()?;
    let server = tiny_http::Server::from_listener(listener, None).map_err(io::Error::other)?;
    let (ip, board) = (address.ip(), Arc::clone(board));
    let requests = AtomicUsize::new(0);
    let shared = Arc::new(Shared { address: ip, site, board, requests });
    thread::Builder::new().name("live".to_owned()).spawn(move || {
        for request in server.incoming_requests() {
            shared.accept(request);
        }
    })?;
    Ok(address)
}

impl Shared {
    /// Answers a request on a thread of its own, since the client may be slow to read.
    fn accept(self: &Arc<Self>, request: Request) {
        if self.requests.fetch_add(1, Ordering::Relaxed) >= MOST_REQUESTS {
            self.requests.fetch_sub(1, Ordering::Relaxed);
            // The client may be gone.
            let _ = request.respond(refusal(503, "too many viewers"));
            return;
        }
        let shared = Arc::clone(self);
        thread::spawn(move || {
            let _ = shared.answer(request);
            shared.requests.fetch_sub(1, Ordering::Relaxed);
        });
    }

    fn answer(&self, request: Request) -> io::Result<()> {
        let mut hosts = request.headers().iter().filter(|header| header.field.equiv("Host"));
        let host = hosts.next().map_or("", |header| header.value.as_str());
        if hosts.next().is_some() || !is_ours(host, self.address) {
            return request.respond(refusal(403, "this server does not have that name"));
        }
        let get = *request.method() == Method::Get;
        if !get && *request.method() != Method::Head {
            let refusal = refusal(405, "expected GET or HEAD");
            return request.respond(refusal.with_header(header("Allow", "GET, HEAD")));
        }
        let (path, query) = request.url().split_once('?').unwrap_or((request.url(), ""));
        match path {
            "/" => {
                let (page, finished) = (self.site.page(), self.board.lock().finished);
                request.respond(file("text/html; charset=utf-8", page.as_bytes()))?;
                if finished && get {
                    self.board.update(|state| state.fetching = state.fetching.saturating_sub(1));
                }
                Ok(())
            }
            "/updates" if !get => request.respond(file("text/event-stream", &[])),
            "/updates" => {
                let only = query.strip_prefix("run=").and_then(|run| run.parse().ok());
                stream::write(&self.board, only, &mut request.into_writer())
            }
            // Every browser asks for it; there is none.
            "/favicon.ico" => request.respond(Response::empty(204)),
            path => match path.strip_prefix('/').and_then(|name| self.site.file(name)) {
                Some(text) => {
                    request.respond(file("text/plain; charset=us-ascii", text.as_bytes()))
                }
                None => request.respond(refusal(404, "no file of that name")),
            },
        }
    }
}

type Answer = Response<io::Cursor<Vec<u8>>>;

fn file(kind: &str, bytes: &[u8]) -> Answer {
    let answer = Response::from_data(bytes).with_header(header("Content-Type", kind));
    answer
        .with_header(header("Cache-Control", "no-store"))
        .with_header(header("X-Content-Type-Options", "nosniff"))
        .with_header(header("Cross-Origin-Resource-Policy", "same-origin"))
}

fn refusal(status: u16, why: &str) -> Answer {
    Response::from_string(format!("{why}\n")).with_status_code(status)
}

fn header(name: &str, value: &str) -> Header {
    Header::from_bytes(name, value).expect("names and values here are plain ASCII")
}
