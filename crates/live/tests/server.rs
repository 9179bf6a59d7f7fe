//! The server over real sockets: what it serves, what it refuses, and slow viewers.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use live::{Board, Site, serve};

struct Small;

impl Site for Small {
    fn page(&self) -> Arc<str> {
        "<h1>page</h1>".into()
    }

    fn file(&self, name: &str) -> Option<String> {
        (name == "scene-0").then(|| "a scene".to_owned())
    }
}

fn start() -> (Arc<Board>, SocketAddr) {
    let board = Arc::new(Board::default());
    let address = serve(SocketAddr::from(([127, 0, 0, 1], 0)), Arc::new(Small), &board).unwrap();
    assert!(address.ip().is_loopback());
    (board, address)
}

fn connect(address: SocketAddr, request: &str) -> TcpStream {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    stream
}

/// Status and body.
fn ask(address: SocketAddr, method: &str, path: &str, host: &str) -> (u16, String) {
    let request = format!("{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n");
    let mut answer = String::new();
    connect(address, &request).read_to_string(&mut answer).unwrap();
    assert!(!answer.to_lowercase().contains("access-control"), "{answer}");
    let (head, body) = answer.split_once("\r\n\r\n").unwrap();
    (head.split(' ').nth(1).unwrap().parse().unwrap(), body.to_owned())
}

/// A viewer's stream, with the framing of chunks.
struct Stream {
    stream: TcpStream,
    received: String,
}

impl Stream {
    fn open(address: SocketAddr, path: &str) -> Stream {
        let request = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\n\r\n");
        Stream { stream: connect(address, &request), received: String::new() }
    }

    /// Reads until this text arrives.
    fn read_until(&mut self, text: &str) {
        let mut buffer = vec![0; 1 << 16];
        let mut searched = 0;
        while !self.received[searched..].contains(text) {
            searched = self.received.len().saturating_sub(text.len());
            let read = self.stream.read(&mut buffer).unwrap();
            assert!(read > 0, "the stream ended early");
            self.received += std::str::from_utf8(&buffer[..read]).unwrap();
        }
    }

    /// The data of all events.
    fn data(&self) -> Vec<&str> {
        self.received.lines().filter_map(|line| line.strip_prefix("data: ")).collect()
    }
}

#[test]
fn it_serves_its_own_files_and_nothing_else() {
    let (_, address) = start();
    let host = format!("127.0.0.1:{}", address.port());
    assert_eq!(ask(address, "GET", "/", &host), (200, "<h1>page</h1>".to_owned()));
    assert_eq!(ask(address, "GET", "/?x=y", "localhost"), (200, "<h1>page</h1>".to_owned()));
    assert_eq!(ask(address, "GET", "/scene-0", "[::1]:7").1, "a scene");
    assert_eq!(ask(address, "HEAD", "/scene-0", &host), (200, String::new()));
    assert_eq!(ask(address, "HEAD", "/updates", &host).0, 200);
    for path in [
        "/scene-1",
        "/../Cargo.toml",
        "/%2e%2e/Cargo.toml",
        "/..%2fCargo.toml",
        "//scene-0",
        "/scene-0/",
        "/etc/passwd",
        "/./scene-0",
        "/index.html",
        "*",
        "http://localhost/../../etc/passwd",
    ] {
        assert_eq!(ask(address, "GET", path, &host).0, 404, "{path}");
    }
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "BREW"] {
        assert_eq!(ask(address, method, "/", &host).0, 405, "{method}");
    }
    for foreign in ["evil.example", "evil.example:80", "localhost.evil.example", "10.0.0.1", ""] {
        assert_eq!(ask(address, "GET", "/", foreign).0, 403, "{foreign}");
        assert_eq!(ask(address, "GET", "/updates", foreign).0, 403, "{foreign}");
    }
}

#[test]
fn a_viewer_receives_a_run_from_its_beginning() {
    let (board, address) = start();
    board.add(4, "first".to_owned());
    board.add(4, "second".to_owned());
    let mut viewer = Stream::open(address, "/updates");
    viewer.read_until("second\n");
    let under_way = r#"{"ended":0,"under_way":[4]}"#;
    assert_eq!(viewer.data(), [under_way, "4", "first", "second"]);
    board.add(4, "third".to_owned());
    board.end(4);
    viewer.read_until("event: end\ndata: 4\n");
    assert!(viewer.data().contains(&"third"), "{}", viewer.received);
    assert!(viewer.data().contains(&r#"{"ended":1,"under_way":[]}"#), "{}", viewer.received);
    board.finish();
    viewer.read_until("event: finished\n");
    viewer.read_until("\r\n0\r\n\r\n");
}

/// The writer never waits for viewers, and viewers that read miss nothing.
#[test]
fn a_viewer_that_never_reads_delays_nobody() {
    const PARTS: usize = 300;
    let (board, address) = start();
    let stalled = Stream::open(address, "/updates");
    let mut viewers = [0; 2].map(|_| Stream::open(address, "/updates?run=0"));
    while board.viewers() < 3 {
        std::thread::sleep(Duration::from_millis(5));
    }
    // 30 MB, more than the buffers of sockets hold. Nobody reads yet, and the writer goes on.
    for part in 0..PARTS {
        board.add(0, format!("{part:05}{}", "x".repeat(100_000)));
    }
    board.end(0);
    viewers.iter_mut().for_each(|viewer| viewer.read_until("event: end\n"));
    board.finish();
    for viewer in &mut viewers {
        viewer.read_until("event: finished\n");
        let data = viewer.data();
        let numbers = data.iter().filter(|data| data.len() > 1000).map(|data| &data[..5]);
        assert!(numbers.eq((0..PARTS).map(|part| format!("{part:05}"))), "parts are missing");
    }
    // All but the stalled one have left; two have not fetched the page.
    assert_eq!(board.wait_for_viewers(Duration::from_secs(1)), 3);
    ask(address, "GET", "/", "localhost");
    ask(address, "GET", "/", "localhost");
    assert_eq!(board.wait_for_viewers(Duration::from_secs(1)), 1);
    drop(stalled);
    assert_eq!(board.wait_for_viewers(Duration::from_secs(60)), 0);
}
