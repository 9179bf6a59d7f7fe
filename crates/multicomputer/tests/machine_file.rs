//! Machine files: those of the project, and invalid ones.

use std::fs;
use std::path::PathBuf;

use multicomputer::{Machine, MachineError, NetworkModel, Shape, machine_schema};
use serde_json::{Value, json};

fn machines(name: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines")).join(name)
}

fn paragon() -> Value {
    let text = fs::read_to_string(machines("paragon-xps.json")).expect("the file is shipped");
    serde_json::from_str(&text).expect("it is JSON")
}

fn read(file: &Value) -> Result<Machine, MachineError> {
    Machine::from_json(&file.to_string(), "m.json")
}

#[test]
fn the_paragon() {
    let machine = read(&paragon()).unwrap();
    assert_eq!((machine.compute_nodes(), machine.service_nodes()), (56, 2));
    assert_eq!(machine.processor.clock, 50e6);
    assert_eq!(machine.processor.price("cell_step"), Some(64.0 * machine.processor.scale / 50e6));
    assert_eq!(machine.processor.price("daydream"), None);
    assert_eq!(machine.network_model, Some(NetworkModel::LogGp));
    let network = machine.parameters.software.unwrap();
    // The published latency is what an empty message takes.
    let latency = network.send_overhead + network.latency + network.receive_overhead;
    assert_eq!(latency.to_string(), "42 µs");
}

/// Two fields for the same buffers must agree.
#[test]
fn message_buffers_agree() {
    let text = fs::read_to_string(machines("paragon-gp16.json")).expect("the file is shipped");
    let mut file: Value = serde_json::from_str(&text).expect("it is JSON");
    let buffers = |value| json!({ "value": value, "provenance": "assumed", "source": "a test" });
    file["message_layer"] = json!({ "buffers": buffers("1 MiB") });
    assert_eq!(read(&file).unwrap().message_layer.buffer_bytes, Some(1 << 20));
    file["message_layer"] = json!({ "buffers": buffers("64 KiB") });
    assert_eq!(
        message(&file),
        "m.json: message_layer.buffers.value: found 65536 B; expected 1048576 B, as \
         \"node_memory.message_buffers\" says"
    );
}

#[test]
fn the_display_and_the_disks() {
    let text = fs::read_to_string(machines("paragon-display.json")).expect("the file is shipped");
    let change: Value = serde_json::from_str(&text).expect("it is JSON");
    let mut file = paragon();
    for section in ["display", "start_up"] {
        file[section] = change[section].clone();
    }
    let machine = read(&file).unwrap();
    let display = machine.display.unwrap();
    // The measured rates from which the service node's costs are derived: 28 KB/s and 108 KB/s.
    assert!((display.rate(100) * 100.0 / 28e3 - 1.0).abs() < 0.01);
    assert!((display.rate(1_500) * 1_500.0 / 108e3 - 1.0).abs() < 0.01);
    assert_eq!(display.ethernet.bandwidth, 1.25e6);
    assert_eq!(machine.start_up.unwrap().service(1 << 16).to_string(), "36.384 ms");

    for (field, value, expected) in [
        ("display.window", "0 B", "found 0 B; expected a whole number of bytes, at least 1"),
        (
            "display.ethernet.payload",
            "0.5 B",
            "found 0.5 B; expected a whole number of bytes, at least 1",
        ),
        ("start_up.request", "8 B", "found 8 B; expected at least 512 B"),
    ] {
        let pointer = format!("/{}/value", field.replace('.', "/"));
        let mut wrong = file.clone();
        *wrong.pointer_mut(&pointer).expect("the pointer meets a value") = json!(value);
        assert_eq!(message(&wrong), format!("m.json: {field}.value: {expected}"));
    }
}

/// The nodes with 16 MB differ only in memory.
#[test]
fn the_paragon_with_memory() {
    let text = fs::read_to_string(machines("paragon-gp16.json")).expect("the file is shipped");
    let mut file: Value = serde_json::from_str(&text).expect("it is JSON");
    let memory = read(&file).unwrap().node_memory.unwrap();
    assert_eq!(memory.available, 17 << 19);
    assert_eq!(memory.sizes["patch"], 300);
    assert_eq!(memory.page_in(8_192).to_string(), "20.730666667 ms");

    for (field, value, expected) in [
        ("system", "16 MiB", "found 16777216 B of 16777216 B; expected less, so that some is left"),
        (
            "installed",
            "8 MiB",
            "found 8388608 B; expected more than 8912896 B, so that some is left for the program: 7864320 B \
             are the system's and 1048576 B message buffers",
        ),
        ("burst", "0 B", "found 0 B; expected at least 1 B"),
        ("sizes.cell", "2 GB", "found 2000000000 B; expected at most 1 GB"),
    ] {
        let pointer = format!("/node_memory/{}/value", field.replace('.', "/"));
        let mut wrong = file.clone();
        *wrong.pointer_mut(&pointer).expect("the pointer meets a value") = json!(value);
        assert_eq!(message(&wrong), format!("m.json: node_memory.{field}.value: {expected}"));
    }

    let fields = file.as_object_mut().expect("it is an object");
    fields.shift_remove("node_memory");
    fields["title"] = paragon()["title"].clone();
    assert_eq!(file, paragon());
}

#[test]
fn an_ideal_network_needs_no_parameters() {
    let mut file = paragon();
    file["network"] = json!({ "model": "ideal" });
    assert_eq!(read(&file).unwrap().network_model, Some(NetworkModel::Ideal));
}

#[test]
fn caches_are_whole_sets_of_whole_lines() {
    let known =
        |value: Value| json!({ "value": value, "provenance": "assumed", "source": "a test" });
    let level = |size: &str, line: &str, ways: u32| {
        json!({
            "size": known(json!(size)), "line": known(json!(line)), "ways": known(json!(ways)),
            "miss_time": known(json!("40 ns")),
        })
    };
    let caches = |primary: &Value, secondary: Value| {
        let mut file = paragon();
        file["processor"]["caches"] = json!({ "primary": primary, "secondary": secondary });
        read(&file)
    };
    let (first, second) = (level("16 KiB", "16 B", 1), level("512 KiB", "64 B", 2));
    let found = caches(&first, second).unwrap().processor.caches;
    let [first, second] = &found[..] else { panic!("{found:?}") };
    assert_eq!((first.size, first.line, first.ways), (16_384, 16, 1));
    assert_eq!((second.size, second.line, second.ways, second.miss_time), (524_288, 64, 2, 40e-9));
    for (primary, secondary, message) in [
        (
            level("16 KiB", "24 B", 1),
            Value::Null,
            "primary.line.value: found 24 B; expected 1 B times a power of two, at most 65536 B",
        ),
        (
            level("16 KiB", "32 B", 1),
            level("64 KiB", "16 B", 1),
            "secondary.line.value: found 16 B; expected 32 B times a power of two, at most 65536 B",
        ),
        (
            level("16 KiB", "32 B", 3),
            Value::Null,
            "primary.size.value: found 16384 B; expected 96 B times a power of two, at most \
             1073741824 B",
        ),
    ] {
        let fault = caches(&primary, secondary).unwrap_err().to_string();
        assert!(fault.ends_with(message), "{fault}");
    }
    for page in ["1 B", "256 B", "128 KiB", "1000 B"] {
        let mut file = paragon();
        let translations = json!({
            "entries": known(json!(64)), "page": known(json!(page)), "miss_time": known(json!("1 us")),
        });
        file["processor"]["caches"] =
            json!({ "primary": level("16 KiB", "16 B", 1), "translations": translations });
        let fault = read(&file).unwrap_err().to_string();
        assert!(fault.contains("; expected a power of two, 512 to 65536 B"), "{fault}");
    }
}

#[test]
fn a_model_without_its_parameters_is_refused() {
    let mut file = paragon();
    file["network"] = json!({ "model": "ideal" });
    let message =
        |file: &Value, model| read(file).unwrap().network_on(model).err().unwrap().to_string();
    let title = "Intel Paragon XP/S, 56 compute nodes and 2 service nodes";
    assert_eq!(
        message(&file, NetworkModel::LogGp),
        format!(r#"the {title} has no "network.parameters", which its network needs as "loggp""#)
    );
    assert_eq!(
        message(&without("/network", "links"), NetworkModel::Flit),
        format!(r#"the {title} has no "network.links", which its network needs as "flit""#)
    );
}

#[test]
fn other_topologies() {
    for (kind, shape) in [
        ("torus", Shape::Torus { width: 4, height: 16 }),
        ("crossbar", Shape::Crossbar { places: 58 }),
        ("bus", Shape::Bus { places: 58 }),
    ] {
        let mut file = paragon();
        let mut mesh = file.as_object_mut().unwrap().shift_remove("mesh").unwrap();
        if kind != "torus" {
            mesh = json!({ "hop_time": mesh["hop_time"] });
        }
        file[kind] = mesh;
        assert_eq!(read(&file).unwrap().topology().shape(), shape);
    }
}

/// The shipped file with the value at a JSON pointer replaced.
fn with(pointer: &str, value: Value) -> Value {
    let mut file = paragon();
    *file.pointer_mut(pointer).expect("the pointer meets a value") = value;
    file
}

/// The shipped file with one more field of its links, a number.
fn with_link_field(name: &str, value: i64) -> Value {
    let mut file = paragon();
    file["network"]["links"][name] =
        json!({ "value": value, "provenance": "assumed", "source": "a test" });
    file
}

/// The shipped file without the key at the end of a JSON pointer.
fn without(object: &str, key: &str) -> Value {
    let mut file = paragon();
    let object = file.pointer_mut(object).and_then(Value::as_object_mut);
    object.expect("the pointer meets an object").shift_remove(key).expect("the key is there");
    file
}

/// The message without line and column, which depend on the file's layout.
fn message(file: &Value) -> String {
    match read(file).map(|machine| machine.title) {
        Err(MachineError::File(mut fault)) => {
            (fault.line, fault.column) = (None, None);
            fault.to_string()
        }
        other => panic!("expected a fault of the file, found {other:?}"),
    }
}

#[test]
fn faults_name_place_value_and_what_was_expected() {
    let cases = [
        (
            with("/processor/clock/value", json!("50")),
            r#"m.json: processor.clock.value: found "50" without a unit; expected a frequency such as "50 MHz""#,
        ),
        (
            with("/processor/clock/value", json!(50)),
            r#"m.json: processor.clock.value: found 50 without a unit; expected a frequency such as "50 MHz""#,
        ),
        (
            with("/processor/operations/ray/value", json!("-3 cycles")),
            r#"m.json: processor.operations.ray.value: found "-3 cycles"; expected a number of cycles such as "12 cycles", finite and not negative"#,
        ),
        (
            with("/processor/scale/value", json!(0)),
            "m.json: processor.scale.value: found 0; expected a number above zero",
        ),
        (
            with("/network/parameters/bandwidth/value", json!("0 MB/s")),
            r#"m.json: network.parameters.bandwidth.value: found "0 MB/s"; expected a bandwidth such as "72 MB/s", finite and above zero"#,
        ),
        (
            with("/network/model", json!("pigeon")),
            "m.json: network.model: unknown value \"pigeon\" (there are: ideal, loggp, wormhole, flit, auto)",
        ),
        (
            with("/mesh/width/provenance", json!("guessed")),
            "m.json: mesh.width.provenance: unknown value \"guessed\" (there are: published, derived, assumed, calibrated)",
        ),
        (
            with("/mesh/width/source", json!(" ")),
            r#"m.json: mesh.width.source: found " "; expected where the number comes from"#,
        ),
        (
            with("/mesh/width", json!(4)),
            "m.json: mesh.width: found 4; expected an object of value, provenance and source",
        ),
        (
            with("/compute_nodes/value", json!(0)),
            "m.json: compute_nodes.value: found 0; expected a whole number, 1 to 65535",
        ),
        (
            with("/compute_nodes/value", json!(63)),
            "m.json: mesh: found 4 × 16 = 64 places; expected at least 65, for 63 compute nodes and 2 service nodes",
        ),
        (
            with("/mesh/height/value", json!(65_535)),
            "m.json: mesh: found 4 × 65535 = 262140 places; expected at most 65536",
        ),
        (without("/mesh", "hop_time"), "m.json: mesh: \"hop_time\" is missing; expected it"),
        (
            without("", "mesh"),
            r#"m.json: no "mesh", "torus", "crossbar" or "bus"; expected one of them"#,
        ),
        (
            {
                let mut file = paragon();
                file["bus"] = json!({ "hop_time": file["mesh"]["hop_time"] });
                file
            },
            r#"m.json: bus: found besides "mesh"; expected one of them"#,
        ),
        (
            without("/network", "parameters"),
            "m.json: network: \"parameters\" is missing; expected it",
        ),
        (
            {
                let mut file = without("/network", "links");
                file["network"]["model"] = json!("auto");
                file
            },
            "m.json: network: \"links\" is missing; expected it",
        ),
        (
            with("/network/links/bandwidth/value", json!("10 MB/s")),
            "m.json: network.links.bandwidth.value: found 10 MB/s; expected at least 65 MB/s, the bandwidth of the message layer",
        ),
        (
            with("/network/links/virtual_channels/value", json!(17)),
            "m.json: network.links.virtual_channels.value: found 17; expected 1 to 16",
        ),
        (
            with("/network/links/flit/value", json!("0.5 B")),
            "m.json: network.links.flit.value: found 0.5 B; expected a whole number of bytes, at least 1",
        ),
        (
            with("/network/links/buffer_flits/value", json!(3)),
            "m.json: network.links.buffer_flits.value: found 3; expected at least 4, as many as leave until the first one's room can be used again",
        ),
        (
            with_link_field("allocation_cycles", 3),
            "m.json: network.links: found 3 cycles of routing and allocation; expected fewer than the 3 of a hop",
        ),
        (
            with_link_field("credit_cycles", 6),
            "m.json: network.links.buffer_flits.value: found 8; expected at least 9, as many as leave until the first one's room can be used again",
        ),
        (
            with_link_field("credit_cycles", 0),
            "m.json: network.links.credit_cycles.value: found 0; expected a whole number, 1 to 255",
        ),
        (
            with_link_field("routing_cycles", -1),
            "m.json: network.links.routing_cycles.value: found -1; expected a whole number, 0 or more",
        ),
        (
            with("/processor/clock", json!({ "value": "50 MHz", "provenanse": "published" })),
            r#"m.json: processor.clock.provenanse: unknown field "provenanse", did you mean "provenance"? (there are: value, provenance, source)"#,
        ),
        (json!("x"), r#"m.json: found "x"; expected an object that describes a machine"#),
    ];
    for (file, expected) in cases {
        assert_eq!(message(&file), expected);
    }
}

#[test]
fn faults_of_the_text_name_line_and_column() {
    let text = fs::read_to_string(machines("paragon-xps.json")).unwrap();
    let message = |text: &str| match Machine::from_json(text, "m.json") {
        Err(error) => error.to_string(),
        Ok(_) => panic!("expected an error"),
    };
    assert_eq!(message(""), "m.json:1:0: EOF while parsing a value");
    assert_eq!(message("{\n  \"title\": }"), "m.json:2:12: title: expected value");
    assert_eq!(message(&format!("{text}}}")), "m.json:160:1: trailing characters");
    assert_eq!(
        message(&text.replace("\"50 MHz\"", "\"50 m\"")),
        "m.json:33: processor.clock.value: found \"50 m\" with the unit \"m\"; \
         expected a frequency such as \"50 MHz\" (units: Hz, kHz, MHz, GHz)"
    );
    assert_eq!(
        message(&text.replace("\"cell_step\"", "\"ray\"")),
        "m.json:53:11: processor.operations: found the key \"ray\" twice; expected it once"
    );
}

#[test]
fn the_committed_schema_is_up_to_date() {
    let path = machines("schemas/machine.json");
    let mut text = serde_json::to_string_pretty(&machine_schema()).unwrap();
    text.push('\n');
    if std::env::var_os("UPDATE_SCHEMAS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    let shipped = fs::read_to_string(&path).unwrap();
    assert!(shipped == text, "machines/schemas/machine.json is stale: UPDATE_SCHEMAS=1 cargo test");
}
