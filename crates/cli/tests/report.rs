//! The report in a real browser: its viewer says of every run what runs.csv says.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod browser;

use std::fs;
use std::path::Path;
use std::process::Command;

use browser::Browser;

/// Office on one and on eight processors.
fn run(out: &Path, threads: &str) {
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .args(["run", "experiments/quickstart.json", "--set", "processors=[1,8]"])
        .args(["--threads", threads, "--out"])
        .arg(out)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Rows of runs.csv.
struct Runs(Vec<Vec<String>>);

impl Runs {
    fn read(folder: &Path) -> Runs {
        let text = fs::read_to_string(folder.join("runs.csv")).unwrap();
        Runs(text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect())
    }

    fn number(&self, run: usize, column: &str) -> f64 {
        let place = self.0[0].iter().position(|name| name == column).unwrap();
        self.0[run + 1][place].parse().unwrap()
    }
}

/// What the line under the slider says: local shots, received shots, per cent of time computing.
fn status(page: &mut Browser) -> [f64; 3] {
    let text = page.text("document.getElementById('status').textContent");
    let after = text.split("Until now").nth(1).unwrap_or_else(|| panic!("{text}")).to_owned();
    let numbers = after
        .split(' ')
        .filter(|word| word.starts_with(|c: char| c.is_ascii_digit()))
        .map(|word| word.replace(',', "").parse().unwrap());
    let numbers: Vec<f64> = numbers.collect();
    numbers.try_into().unwrap_or_else(|_| panic!("{text}"))
}

/// Choose a run and wait until it is shown.
fn open(page: &mut Browser, run: usize) {
    page.evaluate(&format!(
        "{{ const s = document.getElementById('run'); s.value = '{run}'; s.dispatchEvent(new Event('change')); }}"
    ));
    page.wait_for(&format!("document.getElementById('viewer').dataset.ready === '{run}'"));
}

fn slide(page: &mut Browser, thousandths: u32) {
    page.evaluate(&format!(
        "{{ const t = document.getElementById('time'); t.value = {thousandths}; t.dispatchEvent(new Event('input')); }}"
    ));
}

#[test]
fn its_viewer_says_what_the_table_says() {
    let Some(mut page) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "2");
    let runs = Runs::read(folder.path());
    page.open(&folder.path().join("report.html"));
    page.wait_for("document.getElementById('viewer').dataset.ready !== undefined");
    for number in [0, 1] {
        open(&mut page, number);
        let [local, received, computing] = status(&mut page);
        assert_eq!(local, runs.number(number, "local_shots"));
        assert_eq!(received, runs.number(number, "received_shots"));
        assert!((computing - 100.0 * runs.number(number, "busy_fraction")).abs() <= 0.051);
        let clock = page.text("document.getElementById('clock').textContent");
        let end: f64 = clock.split(' ').next().unwrap().parse().unwrap();
        assert!((end - runs.number(number, "time_s")).abs() <= 0.01, "{clock}");
    }
    moves_in_time(&mut page, &runs);
    shows_one_environment(&mut page);
    answers(&mut page, &runs);
    assert_eq!(page.complaints(), Vec::<String>::new());
}

/// The slider goes back and forth, the energy balance closes everywhere, and light follows.
fn moves_in_time(page: &mut Browser, runs: &Runs) {
    let picture = "document.getElementById('picture').toDataURL()";
    page.frame();
    let last = page.text(picture);
    slide(page, 400);
    let [local, received, _] = status(page);
    assert!(local < runs.number(1, "local_shots") && received < runs.number(1, "received_shots"));
    assert!(local > 0.0 && received > 0.0);
    let balance = page.text("document.getElementById('balance').textContent");
    assert!(balance.contains("together 100.0000 %"), "{balance}");
    page.frame();
    assert_ne!(page.text(picture), last, "the light has not changed");
    slide(page, 1000);
    page.frame();
    assert_eq!(page.text(picture), last, "the light of the last instant is another");
    assert_eq!(status(page)[0], runs.number(1, "local_shots"));
    page.evaluate("document.getElementById('play').click()");
    page.wait_for("parseFloat(document.getElementById('clock').textContent) > 0.1");
    page.evaluate("document.getElementById('play').click()");
    assert_eq!(page.text("document.getElementById('play').textContent"), "Play");
}

/// Figure 8: a leaf of the tree, chosen by keys, shows that environment alone.
fn shows_one_environment(page: &mut Browser) {
    slide(page, 1000);
    page.frame();
    let picture = "document.getElementById('picture').toDataURL()";
    let whole = page.text(picture);
    page.evaluate("document.querySelector('#tree [aria-selected=true]').focus()");
    // Down to the first processor, open it, down to its first environment.
    for key in ["ArrowDown", "ArrowRight", "ArrowDown"] {
        page.press(key);
    }
    let text = page.text("document.getElementById('status').textContent");
    assert!(text.starts_with("Shown: environment 0."), "{text}");
    assert_eq!(page.text("document.activeElement.dataset.kind"), "environment");
    page.frame();
    assert_ne!(page.text(picture), whole, "the picture is that of the whole scene");
}

/// The questions that a newcomer asks are answered with the numbers of runs.csv.
fn answers(page: &mut Browser, runs: &Runs) {
    let text = page.text("document.querySelector('.answers').textContent");
    let end = format!("at {:.6} s.", runs.number(1, "time_s"));
    assert!(text.contains("finished last") && text.contains(&end), "{text}");
    let speed_up = format!("The speed-up is {:.1} of 8", runs.number(1, "speed_up"));
    assert!(text.contains(&speed_up), "{text}");
    let share =
        format!("{:.0} % of it went into computing", 100.0 * runs.number(1, "busy_fraction"));
    assert!(text.contains(&share), "{text}");
}

#[test]
fn it_is_small_and_the_same_whatever_the_threads() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    run(&one, "1");
    run(&two, "2");
    let read = |out: &Path| fs::read_to_string(out.join("report.html")).unwrap();
    let report = read(&one);
    assert!(report == read(&two), "the report depends on the number of threads");
    assert!(report.len() < 3_000_000, "{} bytes", report.len());
    for outside in ["src=", "http://", "https://", "@import", "url("] {
        let found = report.matches(outside).count();
        let names = report.matches("http://www.w3.org/2000/svg").count();
        assert_eq!(found, if outside == "http://" { names } else { 0 }, "{outside}");
    }
    // Drawn again from saved results it keeps what was recorded.
    let plot = Command::new(env!("CARGO_BIN_EXE_virtwall")).arg("plot").arg(&two).output().unwrap();
    assert!(plot.status.success(), "{}", String::from_utf8_lossy(&plot.stderr));
    assert!(report == read(&two), "drawn again, the report is another");
}
