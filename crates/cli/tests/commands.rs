//! The command from outside: what it prints, what it writes, how it exits.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use common::{Project, SWEEP};

fn virtwall(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_virtwall"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command
}

fn output(project: &Project, arguments: &[&str]) -> (i32, String, String) {
    let Output { status, stdout, stderr } =
        virtwall(&project.path(""), arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (status.code().unwrap(), text(stdout), text(stderr))
}

#[test]
fn a_run_prints_its_table_and_writes_its_results() {
    let project = Project::new(
        &SWEEP
            .replace("[64, 256]", "64")
            .replace("\"title\"", "\"compare_with\": \"paper.csv\", \"title\""),
    );
    project.write(
        "experiments/paper.csv",
        "scene,processors,time_s,speed_up\nbox,1,100,1.00\nbox,2,50,2.00\n",
    );
    let (code, stdout, stderr) = output(&project, &["run", "experiments/x.json"]);
    assert_eq!((code, stderr.as_str()), (0, ""), "{stdout}");
    assert!(stdout.starts_with("test\n"), "{stdout}");
    assert!(stdout.contains("1 speed-up on more than one processor"), "{stdout}");
    assert!(stdout.ends_with("Results are in results/x.\n"), "{stdout}");

    let csv = fs::read_to_string(project.path("results/x/runs.csv")).unwrap();
    assert!(csv.starts_with(
        "scene,processors,local_environments,seed,time_s,speed_up,paper_time_s,paper_speed_up,\
         local_shots,received_shots,messages,message_bytes,busy_fraction,energy_error,"
    ));
    assert_eq!(csv.lines().count(), 4);
    assert!(csv.lines().nth(2).unwrap().starts_with("box,2,4,1996,"));
    let mut names: Vec<_> = fs::read_dir(project.path("results/x"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let expected = [
        "host-times.json",
        "manifest.json",
        "operations.csv",
        "origin.json",
        "report.html",
        "runs.csv",
        "speed_up-by-processors.svg",
    ];
    assert_eq!(names, expected);
}

#[test]
fn quiet_says_nothing() {
    let project = Project::new(SWEEP);
    let said = output(&project, &["run", "experiments/x.json", "--quiet"]);
    assert_eq!(said, (0, String::new(), String::new()));
    assert!(project.path("results/x/runs.csv").exists());
}

#[test]
fn bad_input_exits_with_2_and_leaves_nothing() {
    let project = Project::new(SWEEP);
    project.write("scenes/hole.obj", "v 0 0 0\nf 1 2 3\n");
    project.write("machines/bad.json", "{ \"title\": 7 }");
    for arguments in [
        &["run", "experiments/y.json"][..],
        &["run", "experiments/x.json", "--set", "processors=0"],
        &["run", "experiments/x.json", "--set", "processors=5"],
        &["run", "experiments/x.json", "--set", "scene=hold"],
        &["run", "experiments/x.json", "--set", "scene=../scenes/hole.obj"],
        &["run", "experiments/x.json", "--set", "machine=bad"],
        &["run", "experiments/x.json", "--set", "patch_size=1"],
        &["run", "experiments/x.json", "--set", "patch_size=1e-9 m"],
        &[
            "run",
            "experiments/x.json",
            "--set",
            "plots=[{\"x\":\"seed\",\"y\":\"seed\",\"file\":\"../p\"}]",
        ],
        &["run", "experiments/x.json", "--threads", "0"],
        &["run", "experiments/x.json", "--viewer", "some"],
        &["run", "experiments/x.json", "--viewer", "0"],
        &["run", "experiments/x.json", "--viewer", "1,99"],
        &["run", "experiments/x.json", "--memory", "4"],
        &["run", "experiments/x.json", "--memory", "4 m"],
        &["run", "experiments/x.json", "--memory=-1GB"],
        &["run", "experiments/x.json", "--keep-shots", "experiments/x.json"],
        &["run", "experiments/x.json", "--out", "experiments/x.json"],
        &["run", "experiments"],
        &["plot", "results/x"],
        &["check", "experiments/x.json", "scenes/hole.obj"],
        &["check", "scenes/*.goal"],
        &["scene", "show", "attic"],
        &["scene", "make", "attic"],
        &["scene", "make", "office", "--tables", "3"],
        &["scene", "make", "rooms", "--tables", "50"],
        &["schema", "attic"],
        &["attic"],
    ] {
        let (code, _, stderr) = output(&project, arguments);
        assert_eq!(code, 2, "{arguments:?}: {stderr}");
        assert!(stderr.starts_with("error: ") && !stderr.contains("panicked"), "{stderr}");
        assert!(!project.path("results").exists(), "{arguments:?}");
    }
}

#[test]
fn threads_and_a_second_run_change_no_byte() {
    let project = Project::new(SWEEP);
    let results = |out: &str, threads: &str| {
        let arguments = ["run", "experiments/x.json", "--out", out, "--threads", threads];
        assert_eq!(output(&project, &arguments).0, 0);
        ["runs.csv", "manifest.json"].map(|name| fs::read(project.path(out).join(name)).unwrap())
    };
    let one = results("a", "1");
    assert_eq!(one, results("a", "1"));
    assert_eq!(one, results("b", "2"));
}

/// Hit rates are told, on the console and in the file of what depends on the host.
#[test]
fn kept_shots_are_counted() {
    let project = Project::new(SWEEP);
    let arguments = ["run", "experiments/x.json", "--keep-shots", "shots", "--memory", "0B"];
    let shots = || {
        let (code, stdout, stderr) = output(&project, &arguments);
        assert_eq!((code, stderr.as_str()), (0, ""));
        let line = stdout.lines().find(|line| line.starts_with("Shots: ")).unwrap().to_owned();
        let times = fs::read_to_string(project.path("results/x/host-times.json")).unwrap();
        let times: serde_json::Value = serde_json::from_str(&times).unwrap();
        let names = ["asked", "found_in_memory", "found_on_disk", "cast", "most_bytes_in_memory"];
        (line, names.map(|name| times["shots"][name].as_u64().unwrap()))
    };
    let (line, [asked, in_memory, on_disk, cast, bytes]) = shots();
    assert_eq!((in_memory, bytes, on_disk + cast), (0, 0, asked));
    let expected = format!(
        "Shots: {asked} asked for, 0 found in memory (0.0 MB at most), {on_disk} on disk, {cast} cast."
    );
    assert_eq!(line, expected);
    assert_eq!(shots().1, [asked, 0, asked, 0, 0]);
}

#[test]
fn a_killed_run_goes_on_where_it_was() {
    let seeds: Vec<String> = (0..40).map(|seed| seed.to_string()).collect();
    let sweep = SWEEP.replace("[64, 256]", "4096");
    let sweep = sweep.replace("\"title\"", &format!("\"seed\": [{}], \"title\"", seeds.join(",")));
    let project = Project::new(&sweep);
    let arguments = ["run", "experiments/x.json", "--threads", "1"];
    let partial = project.path("results/x/.partial");
    let finished = || -> Vec<PathBuf> {
        let paths = fs::read_dir(&partial).into_iter().flatten().map(|entry| entry.unwrap().path());
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect()
    };
    let saved = || finished().len();

    let mut child = virtwall(&project.path(""), &arguments).stdout(Stdio::null()).spawn().unwrap();
    while saved() < 3 && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    // The sweep was still under way, and no result of it stands there half-written.
    assert!(saved() >= 3, "it ended too soon to be killed");
    assert!(!project.path("results/x/runs.csv").exists());
    let json = |text: &str| -> serde_json::Value { serde_json::from_str(text).unwrap() };
    let took = finished().into_iter().map(|path| {
        let (text, key) = (fs::read_to_string(&path).unwrap(), path.file_stem().unwrap());
        json(lab::unsealed(key.to_str().unwrap(), &text).unwrap())[1]["cpu_s"].clone()
    });
    let took: Vec<_> = took.collect();

    assert_eq!(output(&project, &arguments).0, 0);
    assert_eq!(output(&project, &["run", "experiments/x.json", "--out", "whole"]).0, 0);
    // Finished runs were not done again: what they took is what they took before.
    let times = json(&fs::read_to_string(project.path("results/x/host-times.json")).unwrap());
    let made_by = &times["provenance"];
    assert!(made_by["start_unix_s"].as_u64().unwrap() > 1_700_000_000, "{made_by}");
    assert_eq!(made_by["command"][1], "run");
    for name in ["commit", "compiler", "operating_system", "architecture"] {
        assert!(!made_by[name].as_str().unwrap().is_empty(), "{made_by}");
    }
    let times = times["runs"]["cpu_s"].as_array().unwrap();
    assert!(took.iter().all(|took| times.contains(took)), "{took:?} {times:?}");
    // The report's viewer shows runs from before and after: those are made again to be recorded.
    for name in ["runs.csv", "manifest.json", "report.html"] {
        let read = |out: &str| fs::read(project.path(out).join(name)).unwrap();
        assert!(read("results/x") == read("whole"), "{name}");
    }
}

#[test]
fn on_threads_the_light_is_the_same_and_no_time_is_virtual() {
    let stop = r#""stop": { "patch_threshold": "0.1 %" }, "title"#;
    let project = Project::new(&SWEEP.replace("[64, 256]", "256").replace("\"title", stop));
    let read = |out: &str, on: &str| {
        let arguments = ["run", "experiments/x.json", "--out", out, "--on", on];
        assert_eq!(output(&project, &arguments).0, 0);
        let csv = fs::read_to_string(project.path(out).join("runs.csv")).unwrap();
        let mut lines = csv.lines().map(|line| line.split(',').map(str::to_owned).collect());
        let header: Vec<String> = lines.next().unwrap();
        let rows: Vec<Vec<String>> = lines.collect();
        let column = move |name: &str| {
            let index = header.iter().position(|cell| cell == name).unwrap();
            rows.iter().map(|row| row[index].clone()).collect::<Vec<_>>()
        };
        let numbers = |name| column(name).iter().map(|cell| cell.parse().unwrap()).collect();
        let light: [Vec<f64>; 4] = ["absorbed", "unshot", "in_transit", "patches"].map(numbers);
        (column("time_s"), light)
    };
    let (time, [absorbed, unshot, in_transit, patches]) = read("threads", "threads");
    on_threads_nothing_is_measured_in_virtual_time(&project);
    let (_, [simulated, left, ..]) = read("simulation", "simulation");
    assert_eq!(time, ["", "", ""]);
    for i in 0..3 {
        // No patch keeps more than the threshold, a thousandth of the lamp's energy.
        assert!(unshot[i].max(left[i]) <= 0.001 * patches[i], "{unshot:?} {left:?}");
        // In the closed box, only what is not absorbed yet can depend on the order of messages.
        let difference = (absorbed[i] - simulated[i]).abs();
        let open = left[i].max(unshot[i] + in_transit[i]);
        assert!(difference <= open + 1e-9, "{absorbed:?} {simulated:?}");
    }
}

/// On a machine that models everything, no column of time has a number; what would be drawn of it says why not.
fn on_threads_nothing_is_measured_in_virtual_time(project: &Project) {
    let machines = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let machine = |name: &str| machines.join(name).display().to_string();
    let plots = r#"plots=[{"x":"processors","y":"time_s"},{"x":"processors","y":"messages"},{"x":"processors","y":"host.clock_s"}]"#;
    for name in ["paragon-display", "paragon-gp16", "paragon-osf1-early", "ultra1", "cluster-64"] {
        let machine = format!("machine=\"{}\"", machine(&format!("{name}.json")));
        let on = ["--on", "threads", "--replace", "--out", "all"];
        let set = ["--set", &machine, "--set", "processors=1", "--set", plots];
        let arguments = [&["run", "experiments/x.json"], &on[..], &set[..]].concat();
        let (code, text, stderr) = output(project, &arguments);
        assert_eq!((code, stderr.as_str()), (0, ""), "{name}");
        assert!(text.contains("\nThreads of this host have no virtual time: "), "{text}");
        let read = |file: &str| fs::read_to_string(project.path("all").join(file)).unwrap();
        let text = read("runs.csv");
        let mut csv = csv::Reader::from_reader(text.as_bytes());
        let header = csv.headers().unwrap().clone();
        for row in csv.records().map(Result::unwrap) {
            for (column, cell) in header.iter().zip(&row) {
                let of_time = ["_s", "_fraction", "speed_up", "efficiency", "gain"];
                let is_virtual = of_time.iter().any(|end| column.ends_with(end));
                assert!(!is_virtual || cell.is_empty(), "{name}: {column} {cell}");
            }
        }
        let says = |file: &str| read(file).contains("(no virtual time on threads)");
        assert!(says("time_s-by-processors.svg") && says("report.html"));
        assert!(!says("messages-by-processors.svg") && !says("host.clock_s-by-processors.svg"));
        assert!(read("report.html").contains("Threads of this host have no virtual time: "));
    }
}

#[test]
fn saved_results_are_drawn_anew() {
    let project = Project::new(SWEEP);
    assert_eq!(output(&project, &["run", "experiments/x.json", "--out", "out"]).0, 0);
    let names = ["report.html", "speed_up-by-processors.svg"];
    let drawn = || names.map(|name| fs::read(project.path("out").join(name)).unwrap());
    let before = drawn();
    // What the viewer shows was recorded in the run, and stands in the report alone.
    fs::remove_file(project.path("out").join(names[1])).unwrap();
    let (code, stdout, _) = output(&project, &["plot", "out"]);
    assert_eq!(
        (code, stdout.as_str()),
        (0, "out/operations.csv\nout/speed_up-by-processors.svg\nout/report.html\n")
    );
    assert_eq!(drawn(), before);
}

/// The figures and tables of repeats in a folder of results, by name.
fn drawn(project: &Project) -> Vec<String> {
    let names = fs::read_dir(project.path("out")).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut drawn: Vec<String> =
        names.filter(|name| name.ends_with(".svg") || name == "summary.csv").collect();
    drawn.sort();
    drawn
}

/// What the experiment file asks for now is drawn from saved results, and what it asked for before is gone.
#[test]
fn saved_results_are_drawn_with_the_present_plots() {
    let with = |plots: &str| SWEEP.replace("\"plots\": [", &format!("\"plots\": [{plots}, "));
    let over =
        r#"{"x": "processors", "y": "time_s", "over": "hemisphere.pixels", "facet": "scene"}"#;
    let project = Project::new(SWEEP);
    let plot = || output(&project, &["plot", "out"]);
    assert_eq!(output(&project, &["run", "experiments/x.json", "--out", "out"]).0, 0);
    let manifest = || fs::read_to_string(project.path("out/manifest.json")).unwrap();
    let (first, csv) = (manifest(), fs::read(project.path("out/runs.csv")).unwrap());
    assert_eq!(
        (plot().2.as_str(), manifest()),
        ("Plots are those of experiments/x.json.\n", first.clone())
    );
    project.write("experiments/x.json", &with(over));
    assert_eq!(plot().0, 0);
    let names = ["speed_up-by-processors.svg", "summary.csv", "time_s-by-processors.svg"];
    assert_eq!(drawn(&project), names);
    let summary = fs::read_to_string(project.path("out/summary.csv")).unwrap();
    assert!(
        summary.contains("\ntime_s-by-processors,box,,processors,1,time_s,hemisphere.pixels,2,"),
        "{summary}"
    );
    // The folder is as if it had been run with these plots.
    let arguments = ["run", "experiments/x.json", "--out", "out2"];
    assert_eq!(output(&project, &arguments).0, 0);
    assert_eq!(manifest(), fs::read_to_string(project.path("out2/manifest.json")).unwrap());
    project.write("experiments/x.json", SWEEP);
    assert_eq!(plot().0, 0);
    assert_eq!(drawn(&project), names[..1]);
    assert_eq!((manifest(), fs::read(project.path("out/runs.csv")).unwrap()), (first, csv));

    // Another configuration's plots are not those of these results.
    project.write("experiments/x.json", &with(over).replace("[1, 2, 4]", "[1, 2]"));
    let (code, _, stderr) = plot();
    assert_eq!(
        (code, stderr.as_str()),
        (
            0,
            "Plots are those of manifest.json: experiments/x.json is of another configuration now: \
             processors is [1,2] there and [1,2,4] here.\n"
        )
    );
    assert_eq!(drawn(&project), names[..1]);
    let unknown = r#"{"x": "processors", "y": "error_l2"}"#;
    project.write("experiments/x.json", &with(unknown));
    let (code, _, stderr) = plot();
    assert_eq!(code, 2);
    assert!(
        stderr.contains("experiments/x.json:4: plots[0].y: unknown column \"error_l2\""),
        "{stderr}"
    );
}

#[test]
fn files_are_told_apart() {
    let project = Project::new(SWEEP);
    let arguments = [
        "check",
        "experiments/x.json",
        "machines/paragon-xps.json",
        "scenes/box.json",
        "scenes/box.obj",
    ];
    let (code, stdout, stderr) = output(&project, &arguments);
    assert_eq!((code, stderr.as_str()), (0, ""));
    assert_eq!(
        stdout,
        "experiments/x.json: an experiment, 6 runs of 2 problems (scene, mesh, cut and hemisphere)\n\
         machines/paragon-xps.json: a machine, 56 compute nodes and 2 service nodes\n\
         scenes/box.json: a scene, 7 polygons\n\
         scenes/box.obj: an OBJ file, 7 polygons\n"
    );
}

#[test]
fn a_scene_is_shown_in_numbers_and_as_a_picture() {
    let project = Project::new(SWEEP);
    for how in ["--emitted", "--solved"] {
        let arguments = ["scene", "show", "box", "--png", "box.png", "--cut-above", "1.5", how];
        let (code, stdout, stderr) = output(&project, &arguments);
        assert_eq!((code, stderr.as_str()), (0, ""));
        assert!(stdout.contains("polygons        7, 1 of them lights\n"), "{stdout}");
        assert!(stdout.contains("emitted power   4.0 3.6 3.2 W (red, green, blue)\n"), "{stdout}");
        let png = fs::read(project.path("box.png")).unwrap();
        assert!(png.starts_with(b"\x89PNG\r\n"));
        fs::remove_file(project.path("box.png")).unwrap();
    }
}

#[test]
fn scenes_are_made_the_same_each_time() {
    let project = Project::new(SWEEP);
    let made = |out: &str| {
        let arguments = ["scene", "make", "office", "--seed", "7", "--out", out];
        assert_eq!(output(&project, &arguments).0, 0);
        ["office.obj", "office.mtl"].map(|name| fs::read(project.path(out).join(name)).unwrap())
    };
    assert_eq!(made("a"), made("b"));
    assert_eq!(output(&project, &["check", "a/office.obj"]).0, 0);
}

#[test]
fn schemas_are_printed_and_a_reader_may_go() {
    let project = Project::new(SWEEP);
    for kind in ["experiment", "machine", "scene"] {
        let (code, stdout, _) = output(&project, &["schema", kind]);
        assert_eq!(code, 0);
        assert!(serde_json::from_str::<serde_json::Value>(&stdout).is_ok(), "{kind}");
    }
    let mut child = virtwall(&project.path(""), &["schema", "experiment"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let ended = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8(ended.stderr).unwrap(), "");
    assert!(ended.status.success());
}

#[test]
fn what_is_shipped_is_valid() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = ["experiments", "machines", "scenes"].into_iter().flat_map(|folder| {
        let entries = fs::read_dir(root.join(folder)).unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    let files: Vec<_> =
        files.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    let checked = virtwall(&root, &["check"]).args(&files).output().unwrap();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}

/// Every ray is a hit or a miss, the fast path's as the plain one's, and on any number of threads.
#[test]
fn bench_rays_counts_every_ray() {
    let project = Project::new(SWEEP);
    let counts = |more: &[&str]| {
        let arguments = ["bench", "rays", "box", "--sources", "6", "--rays", "100"];
        let arguments = [&arguments, more, &["--format", "json"]].concat();
        let (code, stdout, stderr) = output(&project, &arguments);
        assert_eq!((code, stderr.as_str()), (0, ""));
        let measured: serde_json::Value = serde_json::from_str(&stdout).unwrap();
        ["rays", "hits", "misses"].map(|name| measured[name].as_u64().unwrap())
    };
    let fast = counts(&[]);
    assert_eq!((fast[0], fast[1] + fast[2]), (600, 600));
    assert_eq!(counts(&["--plain"]), fast);
    assert_eq!(counts(&["--threads", "4"]), fast);
}

/// No run overwrites results of another configuration, and what is written anew has no figure of before.
#[test]
fn a_folder_of_results_belongs_to_one_configuration() {
    let project = Project::new(SWEEP);
    let run = |more: &[&str]| output(&project, &[&["run", "experiments/x.json"], more].concat());
    let read = |file: &str| fs::read_to_string(project.path(file)).unwrap();
    assert_eq!(run(&[]).0, 0);
    let csv = read("results/x/runs.csv");
    // What is changed on the command line has a folder and a title of its own.
    assert_eq!(run(&["--set", "processors=[1,2]", "--network", "ideal"]).0, 0);
    let folder = "results/x+processors=1,2+network=ideal";
    let manifest: serde_json::Value =
        serde_json::from_str(&read(&format!("{folder}/manifest.json"))).unwrap();
    let title = manifest["title"].as_str().unwrap();
    assert!(title.ends_with(" (processors=[1,2], network=ideal)"), "{title}");
    assert_eq!(run(&["--set", "processors=[1,2]", "--network", "ideal"]).0, 0);
    for (more, message) in [
        (&["--set", "processors=[1,2]"][..], "processors is [1,2,4] there and [1,2] here"),
        (&["--set", "patch_size=0.9 m"], "patch_size is "),
        (&["--set", "stop.collect_every=2 s"], "stop.collect_every is "),
        (&["--set", "machine.network.model=ideal"], "machine"),
        (&["--on", "threads"], "on is \"simulation\" there and \"threads\" here"),
    ] {
        let arguments = [more, &["--out", "results/x"]].concat();
        let (code, stdout, stderr) = run(&arguments);
        assert_eq!((code, stdout.as_str()), (2, ""), "{more:?}: {stderr}");
        assert!(stderr.contains("results/x: has results of another configuration: "), "{stderr}");
        assert!(stderr.contains(message), "{more:?}: {stderr}");
        assert_eq!(read("results/x/runs.csv"), csv, "{more:?}");
    }
    // A changed file is another configuration, a changed title is not.
    let materials = read("scenes/box.mtl");
    project.write("scenes/box.mtl", &materials.replace("0.5", "0.6"));
    let (code, _, stderr) = run(&[]);
    assert!(code == 2 && stderr.contains("SHA-256 of file scenes/box.mtl is "), "{stderr}");
    project.write("scenes/box.mtl", &materials);
    assert_eq!(run(&["--set", "title=Another", "--out", "results/x"]).0, 0);
    // What is replaced leaves no figure behind.
    let figures = || {
        let names = fs::read_dir(project.path("results/x")).unwrap();
        let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.ends_with(".svg")).collect::<Vec<_>>()
    };
    assert!(!figures().is_empty());
    assert_eq!(run(&["--set", "plots=[]", "--out", "results/x"]).0, 0);
    assert_eq!(figures(), [""; 0]);
    assert_eq!(run(&["--set", "processors=1", "--out", "results/x", "--replace"]).0, 0);
}

/// Speed-ups without their base say so; another base may be chosen.
#[test]
fn speed_ups_are_relative_to_a_run_that_there_is() {
    let project = Project::new(&SWEEP.replace("[64, 256]", "64").replace("[1, 2, 4]", "[2, 4]"));
    let run = |more: &[&str]| {
        let (code, said, stderr) =
            output(&project, &[&["run", "experiments/x.json"], more].concat());
        assert_eq!((code, stderr.as_str()), (0, ""));
        said
    };
    let said = run(&[]);
    assert!(said.contains("No speed-up of box: no run on 1 processor to compare with."), "{said}");
    let said = run(&["--set", "speed_up_over=2", "--out", "two"]);
    assert!(!said.contains("No speed-up"), "{said}");
    let csv = fs::read_to_string(project.path("two/runs.csv")).unwrap();
    let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let columns = rows.next().unwrap();
    let place = |name: &str| columns.iter().position(|column| *column == name).unwrap();
    let number = |row: &[&str], name| row[place(name)].parse::<f64>().unwrap();
    let [two, four] = [rows.next().unwrap(), rows.next().unwrap()];
    assert_eq!((number(&two, "speed_up"), number(&two, "efficiency")), (1.0, 1.0));
    let speed_up = number(&two, "time_s") / number(&four, "time_s");
    assert!((number(&four, "speed_up") - speed_up).abs() < 1e-4);
    assert!((number(&four, "efficiency") - speed_up / 2.0).abs() < 1e-4);
    let bad = ["run", "experiments/x.json", "--set", "speed_up_over=0"];
    let (code, _, stderr) = output(&project, &bad);
    assert!(code == 2 && stderr.contains("speed_up_over: 0; expected 1 or more"), "{stderr}");
}
