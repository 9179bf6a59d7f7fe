//! What is refused, and in which words.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::fs;
use std::path::Path;

use common::Project;
use lab::{Plan, Preparing, Solved};
use serde_json::{Value, json};

/// The message for an experiment file, with the project's folder taken out of it.
fn message(project: &Project, arguments: &[&str]) -> String {
    let arguments: Vec<String> = arguments.iter().map(|&a| a.to_owned()).collect();
    let Err(fault) =
        Plan::read(&project.path("experiments/x.json"), &arguments, &Preparing::default())
    else {
        return "nothing wrong".to_owned();
    };
    fault.to_string().replace(&project.path("").display().to_string(), "")
}

/// The names of the built-in files of a folder and of the project's own, sorted.
fn named(folder: &str, own: &[&str]) -> Vec<String> {
    let paths = shipped::json_files(&Path::new(shipped::ROOT).join(folder));
    let built_in = paths.iter().map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned());
    let mut names: Vec<String> = built_in.chain(own.iter().map(|&own| own.to_owned())).collect();
    names.sort();
    names
}

#[test]
fn experiments_are_refused_with_place_value_and_expectation() {
    let good = r#""title": "t", "scene": "box", "processors": 1, "local_environments": 4"#;
    let walled = &format!(r#"{good}, "interfaces": "virtual_walls", "virtual_walls":"#);
    for (text, expected) in [
        ("{", "experiments/x.json:1:1: EOF while parsing an object"),
        ("[]", "experiments/x.json: found a list; expected an object"),
        (
            "{\n\"title\": \"t\",\n\"title\": \"u\"}",
            "experiments/x.json:3:7: found the key \"title\" twice; expected it once",
        ),
        (
            r#"{"title": "t", "processors": 1}"#,
            "experiments/x.json: \"scene\" is missing; expected it",
        ),
        (
            &format!("{{{good},\n\"processor\": 2}}"),
            "experiments/x.json:2: processor: unknown field \"processor\", did you mean \
             \"processors\"? (there are: $schema, title, scene, machine, network_tolerance, \
             count_start_up, processors, local_environments, cut, cells, patch_size, \
             emitter_patch_size, refine, hemisphere, interfaces, virtual_walls, mask_bits, source_split, overshoot, \
             ambient, reference, error_causes, accuracy, selection, ties, order, stop, merge_masks, mapping, radiosity_updates, \
             reuse_shots, seed, speed_up_over, compare_with, plots)",
        ),
        (
            &format!("{{{good}, \"stop\": {{\"every\": 1}}}}"),
            "experiments/x.json:1: stop.every: unknown field \"every\" (there are: \
             patch_threshold, energy_threshold, collect_every, shots_without_progress)",
        ),
        (
            &format!("{{{good},\n \"hemisphere\": {{\"pixels\":\n \"many\"}}}}"),
            "experiments/x.json:3: hemisphere.pixels: found \"many\"; expected a whole \
             number, 0 or more",
        ),
        (
            &format!("{{{good},\n \"hemisphere\": {{\"pixels\": [64,\n 0]}}}}"),
            "experiments/x.json:3: hemisphere.pixels[1]: 0 pixels do not make a Fibonacci \
             hemisphere; expected 1 to 16777216",
        ),
        (
            &format!("{{{good}, \"selection\": \"best\"}}"),
            "experiments/x.json:1: selection: unknown value \"best\" (there are: energy, \
             delta_radiosity)",
        ),
        (
            &format!(
                "{{{good},\n \"machine\": {{\"node_memory\": {{\"installed\": \"8 MiB\"}}}}}}"
            ),
            "experiments/x.json:2: machine.node_memory: \"system\" is missing; expected it",
        ),
        (
            &format!(
                "{{{good}, \"machine\": {{\n\"processor\": {{\n\"clock\": [\"50 MHz\",\n\"5\"]}}}}}}"
            ),
            "experiments/x.json:4: machine.processor.clock[1]: found \"5\" without a unit; expected \
             a frequency such as \"50 MHz\"",
        ),
        (
            &format!("{{{good}, \"machine\": {{\"mesh\": {{\n\"widht\": 5}}}}}}"),
            "experiments/x.json:2: machine.mesh.widht: unknown field \"widht\", did you mean \
             \"width\"? (there are: width, height, hop_time)",
        ),
        (
            &format!("{{{good}, \"machine\": [\"paragon-xps\",\n{{\"mesh\": {{\"widht\": 5}}}}]}}"),
            "experiments/x.json:2: machine[1].mesh.widht: unknown field \"widht\", did you mean \
             \"width\"? (there are: width, height, hop_time)",
        ),
        (
            &format!("{{{good},\n\"machine\": {{\"compute_nodes\": [56, 63]}}}}"),
            "experiments/x.json:2: machine.mesh: found 4 × 16 = 64 places; expected at least 65, \
             for 63 compute nodes and 2 service nodes",
        ),
        (
            &format!("{{{good},\n\"machine\": {{\"extends\": \"cm-5\"}}}}"),
            "experiments/x.json:2: machine.extends: unknown machine \"cm-5\" (there are: MACHINES)",
        ),
        (
            &format!("{{{good}, \"machine\": 5}}"),
            "experiments/x.json:1: machine: found 5; expected the name of a machine, or an object \
             that \"extends\" one",
        ),
        (
            &format!("{{{good}, \"patch_size\": 0.3}}"),
            "experiments/x.json:1: patch_size: found 0.3 without a unit; expected a length \
             such as \"0.30 m\"",
        ),
        (
            &format!("{{{good}, \"patch_size\": \"0.3\"}}"),
            "experiments/x.json:1: patch_size: found \"0.3\" without a unit; expected a length \
             such as \"0.25 m\"",
        ),
        (
            &format!("{{{good}, \"patch_size\": \"0 m\"}}"),
            "experiments/x.json:1: patch_size: found \"0 m\"; expected a length more than 0",
        ),
        (
            &format!("{{{good}, \"patch_size\": \"0.1 mm\"}}"),
            "experiments/x.json:1: patch_size: 0.0001 m makes some 104857600 patches, up to 4096 x 4096 a \
             polygon; expected at most 20000000",
        ),
        (
            &format!("{{{good}, \"patch_size\": \"2 mm\", \"refine\": {{\"relative_l2\": 0.01}}}}"),
            "experiments/x.json:1: refine: 0.001 m makes some 41959424 patches, up to 4096 x 2048 a \
             polygon; expected at most 20000000",
        ),
        (
            &format!("{{{good}, \"stop\": {{\"patch_threshold\": \"110 %\"}}}}"),
            "experiments/x.json:1: stop.patch_threshold: found \"110 %\"; expected a fraction \
             from 0 % to 100 %",
        ),
        (
            &format!("{{{good},\n \"stop\": {{\"patch_threshold\": [\"1 %\",\n \"0 %\"]}}}}"),
            "experiments/x.json:3: stop.patch_threshold[1]: 0 %, and \"energy_threshold\" 0 %: the run \
             would not end; expected 1e-28 % or more for one of the two",
        ),
        (
            &format!(
                "{{{good}, \"stop\": {{\"patch_threshold\": \"0 %\", \"energy_threshold\": \"1e-320 %\"}}}}"
            ),
            "experiments/x.json:1: stop.patch_threshold: 0 %, and \"energy_threshold\" 1e-320 %: the \
             run would not end; expected 1e-28 % or more for one of the two",
        ),
        (
            &format!("{{{good}, \"stop\": {{\"collect_every\": \"0 s\"}}}}"),
            "experiments/x.json:1: stop.collect_every: found \"0 s\"; expected a time from 1 ps \
             to 86400 s",
        ),
        (
            &format!("{{{good}, \"cut\": \"2x2\"}}"),
            "experiments/x.json:1: cut: \"2x2\" is not three counts of 1 to 4096; expected such \
             as \"14x4x1\"",
        ),
        (
            &format!("{{{good}, \"cut\": \"2x3x1\"}}"),
            "experiments/x.json:1: cut: \"2x3x1\" makes 6 local environments; expected 4",
        ),
        (
            &format!("{{{good}, \"cut\": \"4x1x1\", \"cells\": \"2x8x8\"}}"),
            "experiments/x.json:1: cut: \"4x1x1\" leaves local environments without a cell of \
             2x8x8; expected at most as many as cells along each axis",
        ),
        (
            r#"{"title": "t", "scene": "box", "processors": 1, "local_environments": 131}"#,
            "experiments/x.json:1: local_environments: 131 boxes do not fit the grid of cells of \
             8x4x4; expected a cell or more in each",
        ),
        (
            r#"{"title": "t", "scene": "box", "processors": [1, 0], "local_environments": 4}"#,
            "experiments/x.json:1: processors[1]: 0; expected 1 or more",
        ),
        (
            r#"{"title": "t", "scene": "box", "processors": [1, 8], "local_environments": 4}"#,
            "experiments/x.json:1: processors[1]: 8 processors for 4 local environments; expected \
             at most one for each",
        ),
        (
            r#"{"title": "t", "scene": "box", "processors": 57, "local_environments": 64}"#,
            "experiments/x.json:1: processors: 57 processors, but \"paragon-xps\" has 56 compute \
             nodes; expected at most that",
        ),
        (
            r#"{"title": "t", "scene": "bux", "processors": 1}"#,
            "experiments/x.json:1: scene: unknown scene \"bux\", did you mean \"box\"? (there \
             are: SCENES)",
        ),
        (
            r#"{"title": "t", "scene": "../bux.obj", "processors": 1}"#,
            "experiments/x.json:1: scene: \"../bux.obj\": no such file; expected a path from \
             experiments",
        ),
        (
            &format!("{{{good}, \"machine\": \"cm-5\"}}"),
            "experiments/x.json:1: machine: unknown machine \"cm-5\" (there are: MACHINES)",
        ),
        (
            &format!("{{{good}, \"compare_with\": \"table9.csv\"}}"),
            "experiments/x.json:1: compare_with: \"table9.csv\": no such file; expected a path \
             from this file",
        ),
        (
            &format!("{{{good}, \"plots\": [{{\"x\": \"processors\", \"y\": \"message\"}}]}}"),
            "experiments/x.json:1: plots[0].y: unknown column \"message\", did you mean \
             \"messages\"? (there are: scene, processors, local_environments, seed, time_s, \
             speed_up, paper_time_s, paper_speed_up, local_shots, received_shots, messages, \
             message_bytes, busy_fraction, energy_error, efficiency, update_messages, \
             update_bytes, control_messages, ending, energy_lost, patches, absorbed, unshot, \
             in_transit, escaped, operations, failure, operations.pixel_test, operations.ray, \
             operations.cell_step, operations.polygon_test, operations.hit, operations.plane_test, \
             operations.patch_update, operations.patch_scan, operations.queue_scan, \
             operations.word_copied, host.cpu_s, host.set_up_s, host.clock_s)",
        ),
        (
            &format!(
                "{{{good}, \"plots\": [{{\"x\": \"scene\", \"y\": \"time_s\", \"file\": \"../x\"}}]}}"
            ),
            "experiments/x.json:1: plots[0].file: \"../x\" names a file; expected letters, \
             digits, \"-\", \"_\" and \".\", the first one no \".\"",
        ),
        (
            &format!(
                "{{{good}, \"plots\": [{{\"x\": \"processors\", \"y\": \"time_s\", \"over\": \"seed\"}}]}}"
            ),
            "experiments/x.json:1: plots[0].over: \"seed\" is not swept; with \"over\" expected a \
             swept field (none here)",
        ),
        (
            &format!(
                "{{{good}, \"seed\": [1, 2], \"plots\": [{{\"x\": \"time_s\", \"y\": \"patches\", \
                 \"over\": \"seed\"}}]}}"
            ),
            "experiments/x.json:1: plots[0].x: \"time_s\" is not swept; with \"over\" expected a \
             swept field (seed)",
        ),
        (
            &format!(
                "{{{good}, \"seed\": [1, 2], \"plots\": [{{\"x\": \"seed\", \"y\": \"time_s\", \
                 \"over\": \"seed\"}}]}}"
            ),
            "experiments/x.json:1: plots[0].over: \"seed\" is \"x\" too; expected another swept \
             field (seed)",
        ),
        (
            &format!(
                "{{{good}, \"plots\": [{{\"x\": \"processors\", \"y\": \"time_s\", \
                 \"lines\": [{{\"y\": 2}}, {{\"x\": 1, \"y\": 2}}]}}]}}"
            ),
            "experiments/x.json:1: plots[0].lines[1]: both of \"x\" and \"y\"; expected one of them",
        ),
        (
            &format!(
                "{{{good}, \"plots\": [{{\"x\": \"processors\", \"y\": \"time_s\", \"log_y\": true, \
                 \"lines\": [{{\"y\": 0}}]}}]}}"
            ),
            "experiments/x.json:1: plots[0].lines[0].y: 0 on a logarithmic axis; expected a number above 0",
        ),
        (
            &format!("{{{good}, \"title\": [\"a\", \"b\"]}}").replacen("\"title\": \"t\", ", "", 1),
            "experiments/x.json:1: title: found a list; expected a string",
        ),
        (
            &format!("{{{good}, \"interfaces\": \"walls\"}}"),
            "experiments/x.json:1: interfaces: unknown value \"walls\" (there are: masks, \
             virtual_walls)",
        ),
        (
            &format!("{{{walled} {{\"patches\": \"4x4x4\"}}}}"),
            "experiments/x.json:1: virtual_walls.patches: \"4x4x4\" is not two counts of 1 to 4096; \
             expected such as \"8x8\"",
        ),
        (
            &format!("{{{walled} {{\"patches\": \"4x257\"}}}}"),
            "experiments/x.json:1: virtual_walls.patches: 4 x 257 wall patches; expected 1 to 256 each",
        ),
        (
            &format!("{{{walled} {{\"directions\": [1, 65]}}}}"),
            "experiments/x.json:1: virtual_walls.directions[1]: 65 x 65 directions; expected 1 to 64",
        ),
        (
            &format!("{{{walled} {{\"rays\": 10}}}}"),
            "experiments/x.json:1: virtual_walls.rays: 10 rays for 64 bins of directions; expected at \
             least one each, at most 16777216 in all",
        ),
        (
            &format!("{{{walled} {{\"threshold\": \"0 %\"}}}}"),
            "experiments/x.json:1: virtual_walls.threshold: 0 %; expected 1e-28 % or more: virtual \
             walls hand on ever less, for ever",
        ),
        (
            &format!("{{{good}, \"mask_bits\": 12}}"),
            "experiments/x.json:1: mask_bits: 12 bits; expected 8 or 16",
        ),
        (
            &format!("{{{good}, \"mapping\": []}}"),
            "experiments/x.json:1: mapping: an empty list; expected at least one value to sweep",
        ),
    ] {
        let names = |folder: &str, own: &[&str]| named(folder, own).join(", ");
        let expected = expected
            .replace("MACHINES", &names("machines", &[]))
            .replace("SCENES", &names("scenes", &["box"]));
        assert_eq!(message(&Project::new(text), &[]), expected, "{text}");
    }
}

#[test]
fn arguments_are_named_where_they_are_at_fault() {
    let project = Project::new(common::SWEEP);
    for (argument, expected) in [
        ("processors", "--set processors: expected path=value, such as hemisphere.pixels=4096"),
        ("title.x=1", "--set title.x=1: the path leads into a value that has no fields"),
        (
            "processors=[1,9]",
            "--set processors=[1,9]: processors[1]: 9 processors for 4 local environments; \
             expected at most one for each",
        ),
        (
            "stop.patch_threshold=5",
            "--set stop.patch_threshold=5: stop.patch_threshold: found 5 without a unit; expected \
             a fraction such as \"10 %\"",
        ),
        ("stop.patch_threshold=5 %", "nothing wrong"),
        (
            "stop.patch_threshold=0 %",
            "--set stop.patch_threshold=0 %: stop.patch_threshold: 0 %, and \"energy_threshold\" 0 %: the \
             run would not end; expected 1e-28 % or more for one of the two",
        ),
        ("mapping=[\"blocks\",\"cyclic\"]", "nothing wrong"),
    ] {
        assert_eq!(message(&project, &[argument]), expected, "{argument}");
    }
}

/// The host's memory for the simulated caches of all processors together.
#[test]
fn caches_that_would_fill_the_host_are_refused() {
    let known =
        |value: Value| json!({ "value": value, "provenance": "assumed", "source": "a test" });
    let level = |size: &str, line: &str| {
        json!({
            "size": known(json!(size)), "line": known(json!(line)), "ways": known(json!(1)),
            "miss_time": known(json!("1 ns")),
        })
    };
    for (primary, secondary, processors, expected) in [
        (
            level("1 GiB", "1 B"),
            Value::Null,
            4,
            "the caches of \"cached\" need 34359738368 B of this computer's memory: 4 processors x \
             1073741824 lines x 8 B; expected at most 1073741824 B",
        ),
        (
            level("32 MiB", "1 B"),
            level("32 MiB", "1 B"),
            4,
            "the caches of \"cached\" need 2147483648 B of this computer's memory: 4 processors x \
             67108864 lines x 8 B; expected at most 1073741824 B",
        ),
        (level("32 MiB", "1 B"), Value::Null, 4, ""),
        (level("64 MiB", "1 B"), level("64 MiB", "1 B"), 1, ""),
    ] {
        let text = json!({
            "title": "t", "scene": "box", "machine": "cached", "processors": processors,
            "local_environments": 4
        });
        let project = Project::new(&text.to_string());
        let caches = json!({ "primary": primary, "secondary": secondary });
        let machine = json!({ "extends": "paragon-xps", "processor": { "caches": caches } });
        project.write("machines/cached.json", &machine.to_string());
        let expected = match expected {
            "" => "nothing wrong".to_owned(),
            text => format!("experiments/x.json:1: machine: {text}"),
        };
        assert_eq!(message(&project, &[]), expected);
    }
}

/// An argument inside the machine changes each machine of a sweep, which still is the column "machine".
#[test]
fn arguments_change_every_machine_of_a_sweep() {
    let project = Project::new(
        r#"{"title": "t", "scene": "box", "processors": 1, "local_environments": 4,
            "machine": ["paragon-xps", "slow"],
            "plots": [{"x": "machine", "y": "time_s", "series": "machine"}]}"#,
    );
    project.write("machines/slow.json", r#"{"extends": "paragon-xps", "title": "slow"}"#);
    let arguments = ["machine.network.model=flit", "machine.compute_nodes=48"].map(str::to_owned);
    let path = project.path("experiments/x.json");
    let plan = Plan::read(&path, &arguments, &Preparing::default()).unwrap();
    assert_eq!(
        plan.label(&plan.runs[1]),
        "box, 1 processor, machine slow, network.model flit, compute_nodes 48"
    );
    let list = ["machine.network.model=[\"loggp\",\"flit\"]"];
    let message = message(&project, &list);
    assert!(message.contains("plots[0].x: unknown column \"machine\""), "{message}");
    project.write(
        "experiments/x.json",
        r#"{"title": "t", "scene": "box", "processors": 1,
        "local_environments": 4, "machine": ["paragon-xps", "slow"]}"#,
    );
    let plan = Plan::read(&path, &list.map(str::to_owned), &Preparing::default()).unwrap();
    assert_eq!(plan.runs.len(), 4);
}

#[test]
fn files_that_an_experiment_names_are_refused_at_their_own_places() {
    for (file, text, expected) in [
        (
            "scenes/box.json",
            r#"{"obj": "bax.obj", "patch_size": "1 m"}"#,
            "scenes/box.json:1: obj: \"bax.obj\": no such file in scenes",
        ),
        (
            "scenes/box.json",
            "{\"obj\": \"box.obj\",\n\"patch_size\": 1}",
            "scenes/box.json:2: patch_size: found 1 without a unit; expected a length \
             such as \"0.30 m\"",
        ),
        (
            "scenes/box.json",
            r#"{"obj": "box.obj", "patch_size": "1 m", "cuts": {"4": "2x1x1"}}"#,
            "scenes/box.json:1: cuts.4: \"2x1x1\" makes 2 local environments; expected as many as \
             its key says",
        ),
        (
            "scenes/box.json",
            r#"{"obj": "box.obj", "patch_size": "1 m", "cut": "4x1x1"}"#,
            "scenes/box.json:1: cut: unknown field \"cut\", did you mean \"cuts\"? (there are: \
             $schema, title, obj, made, unit, patch_size, emitter_patch_size, cells, cuts, up, clamp_reflectance, two_sided, materials, objects, media, source)",
        ),
        (
            "scenes/box.json",
            r#"{"obj": "box.obj", "patch_size": "1 m", "media":
                [{"min": [0, 0, 0], "max": [1, 0, 1], "absorption": "1 /m"}]}"#,
            "scenes/box.json:2: media[0]: a box from [0.0, 0.0, 0.0] to [1.0, 0.0, 1.0]; expected \
             \"min\" below \"max\"",
        ),
        (
            "scenes/box.json",
            r#"{"obj": "box.obj", "patch_size": "1 m", "media":
                [{"min": [0, 0, 0], "max": [1, 1, 1], "absorption": "1 m"}]}"#,
            "scenes/box.json:2: media[0].absorption: found \"1 m\" with the unit \"m\"; expected an \
             absorption such as \"0.5 /m\" (units: /m, 1/m)",
        ),
        (
            "scenes/box.json",
            r#"{"obj": "box.obj", "patch_size": "1 m", "media":
                [{"min": [0, 0, 0], "max": [1, 1, 1], "absorption": "1 /m"}]}"#,
            "experiments/x.json:2: reference: \"dense\" knows no \"media\"; expected a scene without them",
        ),
        (
            "scenes/box.json",
            r#"{"patch_size": "1 m"}"#,
            "scenes/box.json: expected either \"obj\", a file, or \"made\"",
        ),
        (
            "scenes/box.json",
            r#"{"made": {"building_floors": 1}, "patch_size": "1 m"}"#,
            "scenes/box.json:1: made.building_floors: 1; expected 2 to 1000",
        ),
        (
            "experiments/paper.csv",
            "scene,processors,time\nbox,1,1\n",
            "experiments/paper.csv:1: no column \"time_s\"; expected scene, processors, time_s, \
             speed_up",
        ),
        (
            "experiments/paper.csv",
            "scene,processors,time_s,speed_up\nbox,1,1,1\nbox,2,fast,1\n",
            "experiments/paper.csv:3: time_s \"fast\"; expected a number above 0, or nothing",
        ),
    ] {
        let project = Project::new(
            r#"{"title": "t", "scene": "box", "processors": 1, "local_environments": 4,
                "compare_with": "paper.csv", "reference": "dense"}"#,
        );
        project.write("experiments/paper.csv", "scene,processors,time_s,speed_up\n");
        project.write(file, text);
        assert_eq!(message(&project, &[]), expected, "{text}");
    }
}

#[test]
fn files_may_begin_with_a_byte_order_mark() {
    let project = Project::new(&format!("\u{feff}{}", common::SWEEP));
    for name in ["scenes/box.json", "machines/paragon-xps.json"] {
        let text = fs::read_to_string(project.path(name)).unwrap();
        project.write(name, &format!("\u{feff}{text}"));
    }
    assert_eq!(message(&project, &[]), "nothing wrong");
}

#[test]
fn a_name_that_would_write_elsewhere_is_refused() {
    let project = Project::new(common::SWEEP);
    let hidden = project.path("experiments/..json");
    fs::copy(project.path("experiments/x.json"), &hidden).unwrap();
    let fault = Plan::read(&hidden, &[], &Preparing::default()).err().unwrap().to_string();
    assert!(fault.contains("the name \".\" names its results; expected letters"), "{fault}");
}

/// A solution for a picture says if it has stopped before what was asked for.
#[test]
fn a_solution_that_stops_early_warns() {
    let solved = |left| Solved { light: Vec::new(), left, shots: 9 };
    assert_eq!(solved(0.1).warning(0.1), None);
    let warning = solved(0.628).warning(0.1).unwrap();
    let expected = "62.8 % of the light is unshot after 9 shots; expected at most 10.0 %";
    assert!(warning.starts_with(expected), "{warning}");
}

/// A field, its values, the problems and machines that are made for 50 of them, and what 1,001 are refused for.
type Case<'a> = (&'a str, &'a dyn Fn(usize) -> String, [usize; 2], Option<&'a str>);

/// Each of them is made before the first run, so that their number is limited; that of runs that share them is not.
#[test]
fn many_problems_and_machines_are_refused_before_they_are_made() {
    let project = Project::new(
        r#"{"title": "t", "scene": "box", "processors": 1, "local_environments": 4, "hemisphere": {"pixels": 64}}"#,
    );
    let path = project.path("experiments/x.json");
    let list = |field: &str, count: usize, item: &dyn Fn(usize) -> String| {
        let items: Vec<String> = (0..count).map(item).collect();
        format!("{field}=[{}]", items.join(","))
    };
    let lengths = |i: usize| format!("\"{} mm\"", 1_000.0 + 0.001 * i as f64);
    let microseconds = |i: usize| format!("\"{} us\"", 100 + i);
    let percent = |i: usize| format!("\"{} %\"", 1.0 + 1e-4 * i as f64);
    let number = |i: usize| (64 + i).to_string();
    let problems =
        "problems, that is scenes that differ in mesh, cut or hemisphere; expected fewer";
    let machines = "more than 1000 different machines; expected fewer";
    let fields: [Case; 6] = [
        ("hemisphere.pixels", &number, [50, 1], Some(problems)),
        ("patch_size", &lengths, [50, 1], Some(problems)),
        ("emitter_patch_size", &lengths, [50, 1], Some(problems)),
        ("machine.network.parameters.latency", &microseconds, [1, 50], Some(machines)),
        ("stop.patch_threshold", &percent, [1, 1], None),
        ("seed", &number, [1, 1], None),
    ];
    for (field, item, made, refused) in fields {
        let few = Plan::read(&path, &[list(field, 50, item)], &Preparing::default()).unwrap();
        assert_eq!([few.problems.len(), few.machines.len()], made, "{field}");
        let many = Plan::read(&path, &[list(field, 1_001, item)], &Preparing::default());
        match (many, refused) {
            (Ok(plan), None) => assert_eq!(plan.runs.len(), 1_001),
            (Err(fault), Some(refused)) => assert!(fault.to_string().contains(refused), "{fault}"),
            (many, _) => panic!("{field}: {:?}", many.err()),
        }
    }
}

#[test]
fn panels_are_of_a_known_column() {
    let project = Project::new(
        r#"{"title": "t", "scene": "box", "processors": 1, "local_environments": 4,
            "plots": [{"x": "processors", "y": "time_s", "facet": "scen"}]}"#,
    );
    let message = message(&project, &[]);
    let expected = "plots[0].facet: unknown column \"scen\", did you mean \"scene\"? (there are: ";
    assert!(message.contains(expected), "{message}");
}
