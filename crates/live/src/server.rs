//! The server: listens, and answers requests for one page, its files and its stream of events.

use std::io;
use std::net::{IpAddr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use crate::answer::{Answer, close};
use crate::board::Board;
use crate::host::is_ours;
use crate::request::{self, NoRequest, Request};
use crate::stream;

/// The most streams at one time.
pub(crate) const MOST_VIEWERS: usize = 64;
/// The most connections at one time, each with a thread: streams, and others that end within seconds.
const MOST_CONNECTIONS: usize = 128;
/// A client that reads nothing for this time is gone.
const MOST_UNREAD: Duration = Duration::from_secs(60);
/// Pause after a connection could not be accepted, for instance because files are used up.
const PAUSE: Duration = Duration::from_millis(50);

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
    connections: AtomicUsize,
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
    let (ip, board) = (address.ip(), Arc::clone(board));
    let connections = AtomicUsize::new(0);
    let shared = Arc::new(Shared { address: ip, site, board, connections });
    thread::Builder::new().name("live".to_owned()).spawn(move || {
        for stream in listener.incoming() {
            match stream {
                Ok(stream) => shared.accept(stream),
                Err(_) => thread::sleep(PAUSE),
            }
        }
    })?;
    Ok(address)
}

/// A connection that is counted, as long as it lives.
struct Connection {
    shared: Arc<Shared>,
    stream: TcpStream,
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.shared.connections.fetch_sub(1, Ordering::Relaxed);
    }
}

impl Shared {
    /// Answers a connection on a thread of its own, since the client may be slow to write and to read.
    fn accept(self: &Arc<Self>, stream: TcpStream) {
        let count = self.connections.fetch_add(1, Ordering::Relaxed);
        let connection = Connection { shared: Arc::clone(self), stream };
        if count >= MOST_CONNECTIONS {
            // Written only if it needs no wait. The client may be gone.
            let _ = connection.stream.set_nonblocking(true);
            let _ = Answer::refusal(503, "too many connections\n").write(&connection.stream, false);
            return;
        }
        // Without a thread the connection is closed. A client that is gone needs no answer.
        let _ = thread::Builder::new().name("live connection".to_owned()).spawn(move || {
            let Connection { shared, stream } = &connection;
            let _ = shared.answer(stream).and_then(|()| close(stream));
        });
    }

    fn answer(&self, stream: &TcpStream) -> io::Result<()> {
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(MOST_UNREAD))?;
        match request::read(stream) {
            Ok(request) => self.answer_request(&request, stream),
            Err(NoRequest::Gone) => Ok(()),
            Err(NoRequest::Refused(status, why)) => {
                Answer::refusal(status, &format!("{why}\n")).write(stream, false)
            }
        }
    }

    fn answer_request(&self, request: &Request, stream: &TcpStream) -> io::Result<()> {
        let head_only = request.method == "HEAD";
        let respond = |answer: Answer<'_>| answer.write(stream, head_only);
        let ours = matches!(&request.hosts[..], [host] if is_ours(host, self.address));
        if !ours {
            return respond(Answer::refusal(403, "this server does not have that name\n"));
        }
        if !head_only && request.method != "GET" {
            return respond(Answer::refusal(405, "expected GET or HEAD\n"));
        }
        let (path, query) = request.url.split_once('?').unwrap_or((&request.url, ""));
        match path {
            "/" => {
                let (page, finished) = (self.site.page(), self.board.lock().finished);
                respond(Answer::file("text/html; charset=utf-8", page.as_bytes()))?;
                if finished && !head_only {
                    self.board.update(|state| state.fetching = state.fetching.saturating_sub(1));
                }
                Ok(())
            }
            "/updates" if head_only => respond(Answer::file("text/event-stream", &[])),
            "/updates" => {
                let only = query.strip_prefix("run=").and_then(|run| run.parse().ok());
                match self.board.add_viewer(MOST_VIEWERS) {
                    true => stream::write(&self.board, only, stream),
                    false => {
                        let why = format!("{MOST_VIEWERS} viewers watch, which is the most\n");
                        respond(Answer::refusal(503, &why))
                    }
                }
            }
            // Every browser asks for it; there is none.
            "/favicon.ico" => respond(Answer::empty()),
            path => match path.strip_prefix('/').and_then(|name| self.site.file(name)) {
                Some(text) => {
                    respond(Answer::file("text/plain; charset=us-ascii", text.as_bytes()))
                }
                None => respond(Answer::refusal(404, "no file of that name\n")),
            },
        }
    }
}
