//! Hostile clients: endless headers, silence, crowds. Memory and threads stay bounded, and others are served.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::time::Duration;

use live::{Board, Site, serve};

struct Page;

impl Site for Page {
    fn page(&self) -> Arc<str> {
        "page".into()
    }

    fn file(&self, _: &str) -> Option<String> {
        None
    }
}

fn start() -> (Arc<Board>, SocketAddr) {
    let board = Arc::new(Board::default());
    let address = serve(SocketAddr::from(([127, 0, 0, 1], 0)), Arc::new(Page), &board).unwrap();
    (board, address)
}

fn connect(address: SocketAddr) -> TcpStream {
    let stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    stream
}

fn send(address: SocketAddr, text: &str) -> TcpStream {
    let mut stream = connect(address);
    stream.write_all(text.as_bytes()).unwrap();
    stream
}

/// All that arrives until the server closes the connection, well or not.
fn received(stream: &mut TcpStream) -> String {
    let (mut bytes, mut buffer) = (Vec::new(), [0; 4096]);
    while let Ok(read @ 1..) = stream.read(&mut buffer) {
        bytes.extend_from_slice(&buffer[..read]);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn status(stream: &mut TcpStream) -> Option<u16> {
    received(stream).split(' ').nth(1)?.parse().ok()
}

fn page(address: SocketAddr) -> Option<u16> {
    let mut stream = connect(address);
    // The server may have closed it.
    let _ = stream.write_all(b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    status(&mut stream)
}

/// Sends `piece` until the server closes the connection.
fn flood(stream: &mut TcpStream, piece: &str) {
    let block = piece.repeat(65_536 / piece.len());
    while stream.write_all(block.as_bytes()).is_ok() {}
}

#[test]
fn endless_headers_are_refused_and_their_connection_is_closed() {
    let (_, address) = start();
    for (begin, piece) in [
        ("GET / HTTP/1.1\r\nX: ", "a"),
        ("GET / HTTP/1.1\r\n", "X-a: b\r\n"),
        ("GET /", "a"),
        ("", "a"),
    ] {
        let mut stream = send(address, begin);
        flood(&mut stream, piece);
        assert_eq!(page(address), Some(200));
    }
    let many = "X-a: b\r\n".repeat(101);
    for (request, expected) in [
        (format!("GET / HTTP/1.1\r\nX: {}\r\n\r\n", "a".repeat(20_000)), 431),
        (format!("GET / HTTP/1.1\r\n{many}\r\n"), 431),
        (format!("GET /{} HTTP/1.1\r\n\r\n", "a".repeat(20_000)), 431),
        ("GET / HTTP/1.1\r\nno colon\r\n\r\n".to_owned(), 400),
        ("\u{1}\u{2}\r\n\r\n".to_owned(), 400),
        ("GET / HTTP/1.1\r\n\r\n".to_owned(), 403),
        ("GET / HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n".to_owned(), 403),
    ] {
        assert_eq!(status(&mut send(address, &request)), Some(expected), "{request:.40}");
    }
}

#[test]
fn a_request_that_arrives_in_pieces_is_answered_and_one_that_never_ends_is_not() {
    let (_, address) = start();
    let mut silent = connect(address);
    let mut half = send(address, "GET / HTTP/1.1\r\nHost: loc");
    let mut slow = connect(address);
    for byte in "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n".bytes() {
        slow.write_all(&[byte]).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(status(&mut slow), Some(200));
    let mut drip = connect(address);
    let dripping = drip.try_clone().unwrap();
    let dripper = std::thread::spawn(move || {
        let mut drip = dripping;
        while drip.write_all(b"G").is_ok() {
            std::thread::sleep(Duration::from_millis(100));
        }
    });
    for stream in [&mut silent, &mut half, &mut drip] {
        assert_eq!(status(stream), Some(408));
    }
    dripper.join().unwrap();
}

#[test]
fn crowds_are_refused_and_leave_room_for_others() {
    let (board, address) = start();
    let request = "GET /updates HTTP/1.1\r\nHost: localhost\r\n\r\n";
    let viewers: Vec<TcpStream> = (0..64).map(|_| send(address, request)).collect();
    while board.viewers() < 64 {
        std::thread::sleep(Duration::from_millis(5));
    }
    let mut refused = send(address, request);
    let answer = received(&mut refused);
    assert!(answer.starts_with("HTTP/1.1 503 ") && answer.contains("64 viewers"), "{answer}");
    assert_eq!(page(address), Some(200));
    // Of 300 silent connections all but 64 are closed at once, and those 64 soon.
    let silent: Vec<TcpStream> =
        (0..300).filter_map(|_| TcpStream::connect(address).ok()).collect();
    #[cfg(target_os = "linux")]
    assert!(std::fs::read_dir("/proc/self/task").unwrap().count() < 250);
    assert_eq!(page(address).filter(|&status| status == 200), None);
    std::thread::sleep(Duration::from_secs(7));
    assert_eq!(page(address), Some(200));
    drop((viewers, silent));
}
