//! `virtwall run --live`: the page in a real browser, and that nobody who looks on changes a result.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod browser;

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use browser::Browser;

/// Rooms on eight processors; the lower the threshold, the longer it takes.
fn command(out: &Path, threshold: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_virtwall"));
    command
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .args(["run", "experiments/quickstart.json", "--set", "scene=rooms"])
        .args([
            "--set",
            "processors=8",
            "--set",
            &format!("stop.patch_threshold={threshold}"),
            "--out",
        ])
        .arg(out)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command
}

/// A run under way, and where it is served.
fn start(out: &Path, threshold: &str) -> (Child, String) {
    let mut run = command(out, threshold).arg("--live").spawn().unwrap();
    let mut lines = BufReader::new(run.stderr.take().unwrap()).lines().map(Result::unwrap);
    let line = lines.find(|line| line.starts_with("Live at ")).unwrap();
    // Somebody has to read on, else the run could not write.
    std::thread::spawn(move || lines.for_each(drop));
    (run, line.strip_prefix("Live at ").unwrap().to_owned())
}

/// Runs.csv and manifest.json.
fn results(out: &Path) -> [String; 2] {
    ["runs.csv", "manifest.json"].map(|name| fs::read_to_string(out.join(name)).unwrap())
}

/// A cell of the only row of runs.csv.
fn number(out: &Path, column: &str) -> f64 {
    let [runs, _] = results(out);
    let mut lines = runs.lines().map(|line| line.split(','));
    let place = lines.next().unwrap().position(|name| name == column).unwrap();
    lines.next().unwrap().nth(place).unwrap().parse().unwrap()
}

/// What the line under the slider counts: local shots, received shots.
fn shots(page: &mut Browser) -> [f64; 2] {
    let text = page.text("document.getElementById('status').textContent");
    let after = text.split("Until now").nth(1).unwrap_or_else(|| panic!("{text}"));
    let words = after.split(' ').filter(|word| word.starts_with(|c: char| c.is_ascii_digit()));
    let numbers: Vec<f64> = words.map(|word| word.replace(',', "").parse().unwrap()).collect();
    [numbers[0], numbers[1]]
}

fn clock(page: &mut Browser) -> f64 {
    let text = page.text("document.getElementById('clock').textContent");
    text.split(' ').next().unwrap().parse().unwrap()
}

#[test]
fn its_page_follows_the_run_and_becomes_the_report() {
    let Some(mut page) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let (mut run, url) = start(out, "2 %");
    page.visit(&url);
    page.wait_for("document.getElementById('viewer').dataset.ready === '0'");
    page.wait_for("parseFloat(document.getElementById('clock').textContent) > 0");
    // Standing still, the page keeps what it shows while the run goes on.
    page.evaluate("document.getElementById('play').click()");
    assert!(!out.join("runs.csv").exists(), "the page came only after the run");
    page.frame();
    let early = (clock(&mut page), shots(&mut page));
    let picture = page.text("document.getElementById('picture').toDataURL()");
    let balance = page.text("document.getElementById('balance').textContent");
    assert!(balance.contains("together 100.00"), "{balance}");
    page.wait_for("document.getElementById('viewer').dataset.ended === '0'");
    page.frame();
    assert_eq!((clock(&mut page), shots(&mut page)), early);
    page.evaluate(
        "{ const t = document.getElementById('time'); t.value = 1000; t.dispatchEvent(new Event('input')); }",
    );
    page.frame();
    let [local, received] = shots(&mut page);
    let end = clock(&mut page);
    assert!(local > early.1[0] && received > early.1[1], "nothing has happened since");
    assert_ne!(page.text("document.getElementById('picture').toDataURL()"), picture);
    let balance = page.text("document.getElementById('balance').textContent");
    assert!(balance.contains("together 100.00"), "{balance}");

    page.wait_for("document.getElementById('sampled').textContent.includes('All runs have ended')");
    page.evaluate("document.getElementById('play').click()");
    page.wait_for("document.querySelector('.answers') !== null");
    page.wait_for("document.getElementById('viewer').dataset.ready === '0'");
    assert_eq!(shots(&mut page), [local, received]);
    assert!(run.wait().unwrap().success());
    assert_eq!([local, received], [number(out, "local_shots"), number(out, "received_shots")]);
    assert!((end - number(out, "time_s")).abs() <= 0.01 * end, "{end}");
    assert_eq!(page.complaints(), Vec::<String>::new());
}

#[test]
fn viewers_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (alone, watched) = (folder.path().join("alone"), folder.path().join("watched"));
    assert!(command(&alone, "4 %").status().unwrap().success());
    let (mut run, url) = start(&watched, "4 %");
    let address = url.strip_prefix("http://").unwrap().trim_end_matches('/').to_owned();
    let viewer = || {
        let mut stream = TcpStream::connect(&address).unwrap();
        write!(stream, "GET /updates HTTP/1.1\r\nHost: {address}\r\n\r\n").unwrap();
        stream
    };
    // One never reads, one reads slowly, one as it comes.
    let _stalled = viewer();
    let mut slow = viewer();
    std::thread::spawn(move || {
        let mut buffer = [0; 64];
        while slow.read(&mut buffer).is_ok_and(|read| read > 0) {
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
    });
    let mut told = Vec::new();
    let mut stream = viewer();
    let mut buffer = [0; 1 << 16];
    while let Ok(read @ 1..) = stream.read(&mut buffer) {
        told.extend(&buffer[..read]);
        if told.ends_with(b"\r\n0\r\n\r\n") {
            break;
        }
    }
    let told = String::from_utf8(told).unwrap();
    assert!(told.matches("event: part\n").count() > 2 && told.contains("event: finished\n"));
    assert!(run.wait().unwrap().success());
    assert_eq!(results(&alone), results(&watched));
    let report = |out: &Path| fs::read_to_string(out.join("report.html")).unwrap();
    assert!(report(&alone) == report(&watched), "the report is another");
}

#[test]
fn what_cannot_be_served_is_bad_input() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = format!("--live={}", taken.local_addr().unwrap().port());
    let cases: [(&[&str], &str); 4] = [
        (&[&port], "--live: cannot listen at 127.0.0.1:"),
        (&["--live", "--on", "threads"], "--live: found --on threads"),
        (&["--live=99999"], "99999"),
        (&["--live-address", "127.0.0.1"], "--live"),
    ];
    for (arguments, complaint) in cases {
        let output = command(&out, "4 %").args(arguments).output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
        assert!(text.contains(complaint), "{arguments:?}: {text}");
        assert!(!out.exists(), "{arguments:?}");
    }
}
