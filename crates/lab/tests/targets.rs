//! An accuracy in place of knobs: what is chosen keeps its promise.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::fs;
use std::sync::Arc;

use common::{Project, options};
use lab::{Options, Plan, Preparing, Results, Stage, Which, carry_out};

fn experiment(more: &str) -> String {
    format!(
        r#"{{ "title": "t", "scene": "box", "processors": [1, 2], "local_environments": 4,
            "reference": "dense", "accuracy": {{ "relative_l2": 0.1, "sweep": "../sweep.csv" }}{more} }}"#
    )
}

/// A project with a sweep whose cheapest run below a tenth took half a second.
fn project(more: &str) -> Project {
    let project = Project::new(&experiment(more));
    let sweep = "scene,time_s,error_l2\nbox,0.1,0.2\nbox,0.5,0.09\nbox,2,0.01\nhall,0.2,0.01\n";
    project.write("sweep.csv", sweep);
    project
}

fn run(threads: usize) -> Results {
    let project = project("");
    let preparing = Preparing { threads, ..Preparing::default() };
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &preparing).unwrap();
    assert_eq!(plan.settings_found().len(), 1, "processors share a setting");
    let options = Options { fresh: true, memory: 1 << 28, ..options(threads) };
    let endings = carry_out(&plan, &project.path("out"), &options, Arc::new(|_| {})).unwrap();
    Results::of(&plan, &endings, &options).unwrap()
}

#[test]
fn the_error_stays_below_what_was_asked_for() {
    let results = run(1);
    for row in &results.table.rows {
        let number = |column| results.table.number(row, column).unwrap();
        assert!(number("error_l2") <= 0.1, "{row:?}");
        assert!(number("predicted_l2") + 3.0 * number("predicted_deviation") <= 0.1, "{row:?}");
        assert_eq!(number("sweep_time_s"), 0.5);
        let over = number("predicted_time_s") / 0.5;
        assert!((number("cost_over_sweep") / over - 1.0).abs() < 1e-3, "{row:?}");
        assert_eq!(results.table.cell(row, "target_l2"), "0.1");
        // A setting ten times as exact would have been a waste.
        assert!(number("predicted_l2") > 0.02, "{row:?}");
    }
    let one = &results.table.rows[0];
    let [time, predicted] =
        ["time_s", "predicted_time_s"].map(|column| results.table.number(one, column).unwrap());
    assert!((time / predicted - 1.0).abs() < 0.01, "{time} {predicted}");
    assert_eq!(run(2).table, results.table);
}

/// The manifest is an experiment, also of settings that were found; each run can be drawn from it.
#[test]
fn results_with_an_accuracy_are_read_back() {
    let project = Project::new(
        r#"{ "title": "t", "scene": ["box", "fine"], "processors": 1, "local_environments": 4,
            "hemisphere": { "rotated": true }, "reference": "dense",
            "accuracy": { "relative_l2": [0.2, 0.1], "sweep": "../sweep.csv" } }"#,
    );
    project.write("sweep.csv", "scene,time_s,error_l2\nbox,0.5,0.09\n");
    let scene = fs::read_to_string(project.path("scenes/box.json")).unwrap();
    project.write("scenes/fine.json", &scene.replace("1 m", "0.7 m"));
    let preparing = Preparing { threads: 2, ..Preparing::default() };
    let read = || Plan::read(&project.path("experiments/x.json"), &[], &preparing);
    let plan = read().unwrap();
    let out = project.path("out");
    let options = Options { memory: 1 << 28, ..options(2) };
    let endings = carry_out(&plan, &out, &options, Arc::new(|_| {})).unwrap();
    let results = Results::of(&plan, &endings, &options).unwrap();
    results.write(&out).unwrap();
    assert!(fs::read_to_string(out.join("report.html")).unwrap().contains(">found</td>"));
    for row in 1..=4 {
        let stage =
            Stage::open(out.to_str().unwrap(), &Which { set: &[], row: Some(row) }).unwrap();
        let end = stage.light_at(&[], || ()).unwrap().1.as_seconds_f64();
        let time = results.table.number(&results.table.rows[row - 1], "time_s").unwrap();
        assert!((end - time).abs() < 1e-6, "{row}: {end} {time}");
    }
    project.write("experiments/x.json", &results.manifest["experiment"].to_string());
    assert_eq!(read().unwrap().settings_found(), plan.settings_found());
}

#[test]
fn knobs_beside_an_accuracy_are_refused() {
    for (more, part) in [
        (r#", "hemisphere": { "pixels": 64 }"#, "is set together with \"accuracy\""),
        (r#", "overshoot": 1.2"#, "expected one of the two"),
    ] {
        let project = project(more);
        let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
        let message = plan.err().unwrap().to_string();
        assert!(message.contains(part), "{message}");
    }
    let project = Project::new(&experiment("").replace("0.1,", "0,"));
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
    assert!(plan.err().unwrap().to_string().contains("expected from 0.0001 to 1"));
}

#[test]
fn a_sweep_that_tells_nothing_is_refused() {
    for (text, part) in [
        (None, "accuracy.sweep: \"../sweep.csv\": no such file; expected a path from this file"),
        (Some("scene,time_s\nbox,1\n"), "has no column \"error_l2\"; expected one"),
        (Some("scene,time_s,error_l2\nbox,1\n"), "expected a runs.csv"),
    ] {
        let project = Project::new(&experiment(""));
        text.iter().for_each(|text| project.write("sweep.csv", text));
        let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
        let message = plan.err().unwrap().to_string();
        assert!(message.contains(part), "{message}");
    }
}
