//! An accuracy in place of knobs: what is chosen keeps its promise.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{Project, options};
use lab::{Options, Plan, Preparing, Results, carry_out};

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
