//! The machines that are shipped: each says what it should, and passes through what was measured.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};

use lab::MachineFile;
use multicomputer::{Machine, ping_pong};

fn machines() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines")
}

fn open(path: &Path) -> MachineFile {
    MachineFile::open(&path.display().to_string()).unwrap()
}

/// Seconds that a message of `bytes` takes between neighbours.
fn one_way(machine: &Machine, bytes: u64) -> f64 {
    ping_pong(machine, machine.network(), (0, 1), bytes, 1).unwrap().as_seconds_f64() / 2.0
}

#[test]
fn every_machine_passes_through_its_published_latency_and_bandwidth() {
    let files = fs::read_dir(machines()).unwrap().map(|entry| entry.unwrap().path());
    let (mut latencies, mut bandwidths) = (0, 0);
    for path in files.filter(|path| path.extension().is_some_and(|ending| ending == "json")) {
        let machine = open(&path).machine;
        let near = |simulated: f64, published: f64, what: &str| {
            let off = simulated / published - 1.0;
            assert!(off.abs() < 0.005, "{}: {what} is off by {off}", path.display());
        };
        if let Some(latency) = machine.published.latency {
            near(one_way(&machine, 0), latency.as_seconds_f64(), "latency");
            latencies += 1;
        }
        if let Some(bandwidth) = machine.published.bandwidth {
            // So long that latency and the last packet hardly count.
            let bytes = 4 << 20;
            near(bytes as f64 / one_way(&machine, bytes), bandwidth, "bandwidth");
            bandwidths += 1;
        }
    }
    assert!(latencies >= 8 && bandwidths >= 9, "{latencies} latencies, {bandwidths} bandwidths");
}

#[test]
fn an_extension_changes_what_it_names_and_nothing_else() {
    let base = open(&machines().join("paragon-xps.json")).machine;
    let early = open(&machines().join("paragon-osf1-early.json")).machine;
    assert_eq!(base.processor, early.processor);
    assert_eq!(base.topology().shape(), early.topology().shape());
    assert_eq!(base.parameters.links, early.parameters.links);
    assert!(early.message_layer.packets.is_some() && base.message_layer.packets.is_none());
    // A larger Paragon differs in size alone.
    let large = open(&machines().join("paragon-1024.json")).machine;
    assert_eq!((large.processor, large.parameters), (base.processor, base.parameters));
    // What was published of the base's latency does not hold for it.
    assert!(open(&machines().join("paragon-nx-1995.json")).machine.published.latency.is_none());
}

#[test]
fn extensions_that_lead_nowhere_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let message = |text: &str| {
        let path = folder.path().join("m.json");
        fs::write(&path, text).unwrap();
        let message = MachineFile::open(&path.display().to_string()).err().unwrap().to_string();
        message.replace(&format!("{}/", folder.path().display()), "")
    };
    let circle = message(r#"{ "extends": "m.json" }"#);
    assert!(circle.ends_with("m.json:1: extends: found \"m.json\"; expected an end of the row"));
    let unknown = message(r#"{ "extends": "n.json" }"#);
    assert!(unknown.starts_with("m.json:1: extends: \"n.json\": no such file"), "{unknown}");
    let base = machines().join("paragon-xps.json");
    let wrong = message(&format!(
        r#"{{ "extends": "{}", "processor": {{ "clock": {{ "value": "50" }} }} }}"#,
        base.display()
    ));
    assert_eq!(
        wrong,
        "m.json:1: processor.clock.value: found \"50\" without a unit; expected a frequency such as \
         \"50 MHz\""
    );
    let less = message(&format!(r#"{{ "extends": "{}", "mesh": null }}"#, base.display()));
    assert_eq!(less, r#"m.json: no "mesh", "torus", "crossbar" or "bus"; expected one of them"#);
}
