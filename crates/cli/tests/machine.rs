//! `virtwall machine` and networks of experiments, from outside.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use common::{Project, SWEEP};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn virtwall(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_virtwall")).current_dir(folder).args(arguments).output();
    let Output { status, stdout, stderr } = output.unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (status.code().unwrap(), text(stdout), text(stderr))
}

const FIXTURES: &str = "machines/fixtures";

fn replay(trace: &str, machine: &str, network: &str) -> (i32, String, String) {
    let [trace, machine] = [trace, machine].map(|name| format!("{FIXTURES}/{name}.json"));
    let arguments = ["machine", "replay", &trace, "--machine", &machine, "--network", network];
    virtwall(&root(), &arguments)
}

#[test]
fn a_replay_prints_the_course_of_every_message() {
    let (code, table, stderr) = replay("head-of-line", "row-of-4", "wormhole");
    assert_eq!((code, stderr.as_str()), (0, ""));
    let expected = "\
id,from,to,bytes,sent_s,arrived_s,blocked_s,blocked_by
first,2,3,1000000,0.000000000000,1.000000000000,0.000000000000,
second,0,3,1000000,0.000000000000,2.000000000000,1.000000000000,first
third,0,1,1000000,0.000000000000,3.000000000000,2.000000000000,second
";
    assert_eq!(table, expected);
    let (code, _, stderr) = replay("round-the-ring", "ring-of-4", "wormhole");
    assert_eq!(code, 1);
    assert!(stderr.starts_with("error: at 200 µs: deadlock in the network: \"from-"), "{stderr}");
}

#[test]
fn a_replay_reads_schedules_and_csv() {
    let project = Project::new(SWEEP);
    let goal = "num_ranks 2\nrank 0 {\na: calc 1000\nb: send 4096b to 1\nb requires a\n}\n\
                rank 1 {\nrecv 4096b from 0\n}\n";
    project.write("t.goal", goal);
    project.write("t.csv", "time,source,destination,bytes\n1 us,0,1,4096\n");
    project.write("bad.goal", "num_ranks 2\nrank 0 {\nsend 1b to 7\n}\n");
    project.write("wait.goal", "num_ranks 1\nrank 0 {\na: calc 1\na requires a\n}\n");
    project.write("bad.csv", "time,source,destination,bytes\n1 us,0,99,4096\n");
    let replay = |name| virtwall(&project.path(""), &["machine", "replay", name]);
    let head = "id,from,to,bytes,sent_s,arrived_s,blocked_s,blocked_by\n";
    let times = ",0,1,4096,0.000001000000,0.000106055385,0.000000000000,\n";
    for (name, id) in [("t.goal", "0.b"), ("t.csv", "0")] {
        let (code, table, stderr) = replay(name);
        assert_eq!((code, stderr.as_str()), (0, ""));
        assert_eq!(table, format!("{head}{id}{times}"));
    }
    for (name, expected) in [
        ("bad.goal", "bad.goal:3: found \"7\"; expected a rank, a whole number, at most 1"),
        ("wait.goal", "wait.goal: at 0 s: 1 operations wait for each other, such as 0.a; expected"),
        ("bad.csv", "bad.csv:2: destination: found \"99\"; expected a whole number, 0 to 57"),
    ] {
        let (code, table, stderr) = replay(name);
        assert_eq!((code, table.as_str()), (2, ""));
        assert!(stderr.starts_with(&format!("error: {expected}")), "{stderr}");
    }
}

#[test]
fn files_of_messages_are_checked() {
    let project = Project::new(SWEEP);
    project.write("t.goal", "num_ranks 2\nrank 0 {\ncalc 1\n}\n");
    project.write("t.csv", "cycle,source,destination,flits\n1,0,70,4\n");
    project.write("bad.csv", "cycle,source,destination,flits\n1,0,one,4\n");
    let check = |name| virtwall(&project.path(""), &["check", name]);
    assert!(check("t.goal").1.ends_with("t.goal: a schedule, 1 operations\n"));
    assert!(check("t.csv").1.ends_with("t.csv: a trace, 1 messages\n"));
    let (code, _, stderr) = check("bad.csv");
    assert_eq!(code, 2);
    assert!(stderr.starts_with("error: bad.csv:2: destination: found \"one\""), "{stderr}");
    if cfg!(unix) {
        let (code, _, stderr) = check("/dev/zero");
        let expected = "error: /dev/zero: cannot be read: not a regular file\n";
        assert_eq!((code, stderr.as_str()), (2, expected));
    }
}

/// Virtual times saturate, which is no answer.
#[test]
fn a_replay_beyond_the_end_of_virtual_time_is_refused() {
    let project = Project::new(SWEEP);
    let slow = r#"{"extends": "paragon-xps", "network": {"parameters": {"bandwidth":
        {"value": "1 B/s", "provenance": "assumed", "source": "none"}}}}"#;
    project.write("slow.json", slow);
    project.write("t.csv", "time,source,destination,bytes\n1 us,0,1,100000000\n");
    let (code, table, stderr) =
        virtwall(&project.path(""), &["machine", "replay", "t.csv", "--machine", "slow.json"]);
    assert_eq!((code, table.as_str()), (1, ""));
    assert!(stderr.starts_with("error: a message arrives later than virtual time"), "{stderr}");
}

#[test]
fn a_replay_can_go_to_a_file() {
    let project = Project::new(SWEEP);
    let trace = r#"[{"id": "a", "at": "0 us", "from": 0, "to": 3, "bytes": 4096, "after": []}]"#;
    project.write("t.json", trace);
    let folder = project.path("");
    let arguments = "machine replay t.json --network wormhole --out t.csv --channels c.csv";
    let arguments: Vec<&str> = arguments.split(' ').collect();
    let (code, said, _) = virtwall(&folder, &arguments);
    assert_eq!((code, said.as_str()), (0, "1 messages; the table is in t.csv.\n"));
    let table = fs::read_to_string(project.path("t.csv")).unwrap();
    // 4,096 B at 175 MB/s.
    let channels = fs::read_to_string(project.path("c.csv")).unwrap();
    assert!(channels.contains("\nlink 1→2,1,0.000023405714,0.0000234"), "{channels}");
    assert!(channels.contains("\nlink 2→1,0,0.000000000000,0.000000000000,0.000000\n"));
    // 42 µs, 3 hops of 40 ns, 4,096 B at 65 MB/s.
    assert!(
        table.ends_with("a,0,3,4096,0.000000000000,0.000105135385,0.000000000000,\n"),
        "{table}"
    );
}

#[test]
fn bad_traces_and_networks_exit_with_2_and_leave_nothing() {
    let project = Project::new(SWEEP);
    project.write("t.json", r#"[{"id": "a", "at": "0 us", "from": 0, "to": 58, "bytes": 1}]"#);
    project.write(
        "c.json",
        r#"[{"id": 1, "at": "0 us", "from": 0, "to": 5, "bytes": 1, "after": [1]}]"#,
    );
    project.write("g.json", "[]");
    let machine = fs::read_to_string(project.path("machines/paragon-xps.json")).unwrap();
    let links = machine.find(",\n    \"links\"").unwrap();
    project.write("machines/no-links.json", &format!("{}\n  }}\n}}", &machine[..links]));
    for (arguments, message) in [
        (
            &["machine", "replay", "t.json"][..],
            "t.json:1: [0].to: found 58; expected a node, 0 to 57",
        ),
        (
            &["machine", "replay", "c.json"],
            "c.json:1: [0].after: found a circle, \"1\" after \"1\"; expected messages that can be sent",
        ),
        (&["machine", "replay", "none.json"], "none.json: cannot be read"),
        (&["machine", "replay", "g.json", "--machine", "cray"], "unknown machine \"cray\""),
        (&["machine", "replay", "g.json", "--network", "pigeon"], "found \"pigeon\"; expected"),
        (
            &["machine", "replay", "g.json", "--machine", "no-links", "--network", "flit"],
            "has no \"network.links\", which its network needs as \"flit\"",
        ),
        (
            &["run", "experiments/x.json", "--network", "pigeon"],
            "--set machine.network.model=pigeon: machine.network.model: unknown value \"pigeon\"",
        ),
        (
            &[
                "run",
                "experiments/x.json",
                "--set",
                "machine.network.model=flit",
                "--network",
                "loggp",
            ],
            "--network loggp: found --set machine.network.model=flit too; expected one of the two",
        ),
        (
            &["run", "experiments/x.json", "--set", "machine=no-links", "--network", "wormhole"],
            "--set machine.network.model=wormhole: machine.network: \"links\" is missing; expected it",
        ),
    ] {
        let (code, _, stderr) = virtwall(&project.path(""), arguments);
        assert_eq!(code, 2, "{arguments:?}: {stderr}");
        assert!(stderr.contains(message), "{arguments:?}: {stderr}");
        assert!(!project.path("results").exists(), "{arguments:?}");
    }
}

/// Rows of the results of the small project's sweep over networks, a map from column to cell each.
fn rows(project: &Project) -> Vec<Vec<(String, String)>> {
    let csv = fs::read_to_string(project.path("results/x/runs.csv")).unwrap();
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let cells = line.split(',').map(str::to_owned);
        names.iter().map(|name| (*name).to_owned()).zip(cells).collect()
    };
    lines.map(row).collect()
}

fn cell<'a>(row: &'a [(String, String)], name: &str) -> &'a str {
    row.iter().find(|(column, _)| column == name).map_or("", |(_, cell)| cell)
}

#[test]
fn an_experiment_runs_on_every_network_and_says_what_differs() {
    let networks = r#""machine": { "network": { "model": ["ideal", "loggp", "wormhole", "flit", "auto"] } }, "title""#;
    let text = SWEEP.replace("[64, 256]", "64").replace("\"title\"", networks);
    let project = Project::new(&text);
    let (code, said, stderr) = virtwall(&project.path(""), &["run", "experiments/x.json"]);
    assert_eq!((code, stderr.as_str()), (0, ""), "{said}");
    assert!(said.contains("  network   farthest from the finest     CPU s\n"), "{said}");
    let rows = rows(&project);
    assert_eq!(rows.len(), 15);
    for row in &rows {
        let (asked, used) = (cell(row, "machine.network.model"), cell(row, "network_used"));
        let difference: f64 =
            cell(row, "difference_from_finest").trim_end_matches(" %").parse().unwrap();
        match asked {
            "flit" => assert_eq!(difference, 0.0),
            "auto" => {
                assert!(difference.abs() <= 1.0, "{row:?}");
                assert!(cell(row, "network_why").contains("a pilot of "), "{row:?}");
            }
            _ => assert_eq!(asked, used),
        }
        let blocked: f64 = cell(row, "blocked_s").parse().unwrap();
        assert!(blocked == 0.0 || used != "ideal", "{row:?}");
    }
}

#[test]
fn a_machine_is_shown_and_measured() {
    let (code, text, _) = virtwall(&root(), &["machine", "show", "paragon-xps"]);
    assert_eq!(code, 0);
    assert!(text.contains("56 compute nodes and 2 service nodes (s) on a mesh, 4 x 16"), "{text}");
    assert!(text.contains("\n  52 - 53 - 54 - 55\n   s -  s -  . -  .\n"), "{text}");
    assert!(text.contains("network.links.bandwidth = 175 MB/s (published: "), "{text}");

    let project = Project::new(SWEEP);
    let (code, text, _) =
        virtwall(&project.path(""), &["machine", "bench", "paragon-xps", "--out", "bench"]);
    assert_eq!(code, 0);
    assert!(text.contains("\n     4096       105.06      38.99"), "{text}");
    assert!(text.contains("Published: latency 42 µs, bandwidth 65 MB/s."), "{text}");
    let svg = fs::read_to_string(project.path("bench/megabytes_a_second-by-bytes.svg")).unwrap();
    assert!(svg.contains("published") && svg.contains("model loggp"));

    let (code, text, _) = virtwall(&root(), &["machine", "bench", "paragon-osf1-early"]);
    assert_eq!(code, 0);
    // All nodes send four messages of 1 MiB before they read one, into buffers of 1 MiB.
    assert!(text.contains("\n  1048576     32358.40      32.41     deadlock"), "{text}");
}

/// Answers on several messages at once say what their model leaves out. The bytes that a node receives a second
/// from many senders are bounded by its port.
#[test]
fn a_model_without_contention_says_so() {
    let bench = |machine: &str, model: &str| {
        let (code, text, _) = virtwall(&root(), &["machine", "bench", machine, "--network", model]);
        assert_eq!(code, 0, "{machine}, {model}");
        text
    };
    let numbers = |text: &str| -> Vec<f64> {
        let line = text.lines().find(|line| line.trim_start().starts_with("1048576 ")).unwrap();
        line.split_whitespace().map(|cell| cell.parse().unwrap()).collect()
    };
    for machine in ["paragon-xps", "paragon-1024", "cluster-64", "workstations", "origin2000"] {
        let text = bench(machine, "loggp");
        assert!(text.contains("\nModel loggp has no contention in links: "), "{text}");
        assert_eq!(text.contains("; --network wormhole"), machine != "origin2000", "{text}");
        assert!(!text.contains("In the hot spot"), "{text}");
        let [bytes, _, one, _, each] = numbers(&text)[..] else { panic!("{text}") };
        assert!(bytes / each < 1.05 * one, "{text}");
        assert!(bench(machine, "ideal").contains("\nModel ideal has no cost and no contention: "));
    }
    let paced = bench("paragon-xps", "wormhole");
    let sentence = "In the hot spot a node receives 173 MB/s, from one sender 65 MB/s: a sender's";
    assert!(paced.contains(sentence) && !paced.contains("Model "), "{paced}");
    assert!(!bench("cluster-64", "wormhole").contains("In the hot spot"));
}

#[test]
fn every_machine_is_shown_and_measured() {
    let files = fs::read_dir(root().join("machines")).unwrap().map(|entry| entry.unwrap().path());
    let machines = files.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    for machine in machines.map(|path| path.display().to_string()) {
        let (code, text, stderr) = virtwall(&root(), &["machine", "show", &machine]);
        assert_eq!((code, stderr.as_str()), (0, ""), "{machine}");
        assert!(text.contains(" (s) on a "), "{text}");
        let (code, text, stderr) = virtwall(&root(), &["machine", "bench", &machine]);
        assert_eq!((code, stderr.as_str()), (0, ""), "{machine}");
        // Two are there for their processors' caches, and nothing published of their networks is known.
        let caches = ["ultra1.json", "origin2000.json"].iter().any(|name| machine.ends_with(name));
        assert!(caches || text.contains("\nPublished: "), "{text}");
    }
    let hub = |name| virtwall(&root(), &["machine", "show", name]).1;
    let bus = hub("workstations");
    assert!(bus.contains("16 compute nodes and 1 service node (s) on a bus (=) with 17"), "{bus}");
    assert!(bus.contains("\n   s\n   |\n  ==\n"), "{bus}");
    assert!(hub("cluster-64").contains("\n   s\n   |\n  ##\n"));
    let wide = hub("paragon-1024");
    assert!(wide.contains("    8 -    9 - ... -   58 -   59 -"), "{wide}");
}

#[test]
fn worms_are_compared_with_flits() {
    let small = ["machine", "compare", "paragon-xps", "--bytes", "64", "--messages", "8"];
    let (code, table, stderr) = virtwall(&root(), &small);
    assert_eq!((code, stderr.as_str()), (0, ""));
    for pattern in ["uniform", "neighbour", "transpose", "hot-spot", "all-to-one"] {
        assert!(table.contains(pattern), "{table}");
    }
    assert!(table.contains("Below saturation mean latencies differ by "), "{table}");
}

#[test]
fn what_the_display_and_the_start_up_do_stands_in_the_results() {
    let text = SWEEP
        .replace("[64, 256]", "64")
        .replace("\"title\"", r#""machine": ["paragon-xps", "paragon-display"], "title""#);
    let project = Project::new(&text);
    let machine = fs::read_to_string(root().join("machines/paragon-display.json")).unwrap();
    project.write("machines/paragon-display.json", &machine);
    let run = |settings: &[&str]| {
        let settings = settings.iter().flat_map(|setting| ["--set", setting]);
        let command = ["run", "experiments/x.json", "--out", "results/x", "--replace"];
        let arguments: Vec<&str> = command.into_iter().chain(settings).collect();
        virtwall(&project.path(""), &arguments)
    };
    assert_eq!(run(&[]).0, 0);
    let beside = rows(&project);
    let number = |row: &[(String, String)], name: &str| cell(row, name).parse::<f64>().unwrap();
    // Nothing stands beside a machine that says nothing of them; nothing else differs.
    assert_eq!([cell(&beside[0], "display_lag_s"), cell(&beside[0], "start_up_s")], ["", ""]);
    let [without, with] = [&beside[2], &beside[5]];
    assert_eq!(cell(with, "time_s"), cell(without, "time_s"));
    assert_eq!(cell(with, "updates_shown"), cell(with, "update_messages"));
    assert_eq!(number(with, "updates_dropped"), 0.0);
    assert!(number(with, "display_lag_s") > 0.0 && number(with, "service_busy_fraction") > 0.0);
    // Four nodes read some hundred bytes, one after the other.
    let [all, reading, waited] =
        ["start_up_s", "reading_s", "disk_wait_s"].map(|c| number(with, c));
    assert!(
        (waited * 4.0 / 3.0 - reading).abs() < 1e-5 && reading < all,
        "{waited} {reading} {all}"
    );

    let drowned = ["machine=paragon-display", r#"machine.display.consumer.update_time="1 s""#];
    let drops = ["machine.display.when_full=drop_newest", "machine.display.service_buffers=1 B"];
    assert_eq!(run(&[&drowned[..], &drops].concat()).0, 0);
    assert!(rows(&project).iter().any(|row| number(row, "updates_dropped") > 0.0));

    assert_eq!(run(&["machine=paragon-display", "count_start_up=true"]).0, 0);
    let counted = &rows(&project)[2];
    let computing = number(counted, "time_s") - number(counted, "start_up_s");
    assert!((computing - number(with, "time_s")).abs() < 2e-6);

    let lacks = |setting: &str, expected: &str| {
        let (code, _, stderr) = run(&["machine=paragon-xps", setting]);
        assert_eq!(code, 2);
        assert!(stderr.contains(expected), "{stderr}");
    };
    lacks("machine.display.window=1 B", "machine.display: \"service\" is missing; expected it");
    lacks("count_start_up=true", "expected a machine whose file has \"start_up\"");
}

#[test]
fn what_paging_does_stands_in_the_results() {
    let memory =
        r#""machine": { "extends": "gp16", "node_memory": { "installed": ["16 MiB", "9 MiB"] } }"#;
    let text = SWEEP
        .replace("[64, 256]", "64")
        .replace("[1, 2, 4]", "4")
        .replace("\"title\"", &format!("{memory}, \"title\""));
    let project = Project::new(&text);
    let gp16 = fs::read_to_string(root().join("machines/paragon-gp16.json")).unwrap();
    project.write("machines/gp16.json", &gp16);
    let (code, _, stderr) = virtwall(&project.path(""), &["run", "experiments/x.json"]);
    assert_eq!((code, stderr.as_str()), (0, ""));
    let rows = rows(&project);
    let number = |row: usize, name: &str| cell(&rows[row], name).parse::<f64>().unwrap();
    // Program and message buffers fill the smaller node; its patches are paged.
    assert_eq!(number(0, "paging_s"), 0.0);
    assert!(number(1, "paging_s") > 0.0 && number(1, "time_s") > number(0, "time_s"));
    assert!(number(1, "memory_high_water") > 0.0);
}

#[test]
fn what_a_message_layer_does_stands_in_the_results() {
    let text = SWEEP
        .replace("[64, 256]", "64")
        .replace("[1, 2, 4]", "4")
        .replace("\"title\"", r#""machine": ["paragon-xps", "roomy", "relieved"], "title""#);
    let project = Project::new(&text);
    let extension = |name: &str, layer: &str| {
        let number =
            |value| format!(r#"{{ "value": "{value}", "provenance": "assumed", "source": "t" }}"#);
        let layer = layer.replace("1B", &number("1 B")).replace("1us", &number("1 us"));
        let layer = layer.replace("1MB/s", &number("1 MB/s"));
        let text = format!(r#"{{ "extends": "paragon-xps", "message_layer": {{ {layer} }} }}"#);
        project.write(&format!("machines/{name}.json"), &text);
    };
    extension("roomy", r#""packets": { "size": 1B, "time": 1us }, "copy_bandwidth": 1MB/s"#);
    extension("relieved", r#""coprocessor": { "handover": 1us }, "buffers": 1B"#);
    let (code, _, stderr) = virtwall(&project.path(""), &["run", "experiments/x.json"]);
    assert_eq!((code, stderr.as_str()), (0, ""));
    let rows = rows(&project);
    let number = |row: usize, name: &str| cell(&rows[row], name).parse::<f64>().unwrap();
    // Nothing stands beside a machine that says nothing of its message layer.
    assert_eq!(cell(&rows[0], "copying_s"), "");
    // A microsecond a byte, of sources and of the few bytes of control.
    assert!(number(1, "packing_s") > number(1, "message_bytes") * 1e-6);
    assert!(number(1, "copying_s") > 0.0 && number(1, "unposted_messages") > 0.0);
    assert_eq!(number(1, "buffer_bytes_most"), 0.0);
    assert!(number(2, "coprocessor_s") > 0.0 && number(2, "held_messages") > 0.0);
    assert_eq!((number(2, "packing_s"), number(2, "waiting_for_room_s")), (0.0, 0.0));
    assert!(number(2, "buffer_bytes_most") > 1.0, "a message may be longer than the buffers");
}
