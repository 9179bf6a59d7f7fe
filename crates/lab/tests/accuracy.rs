//! An accuracy in place of knobs: what is chosen keeps its promise.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::Project;
use lab::{On, Options, Plan, Preparing, Results, Viewing, carry_out};

fn experiment(more: &str) -> String {
    format!(
        r#"{{ "title": "t", "scene": "box", "processors": [1, 2], "local_environments": 4,
            "reference": "dense", "accuracy": {{ "relative_l2": 0.1 }}{more} }}"#
    )
}

fn run(threads: usize) -> Results {
    let project = Project::new(&experiment(""));
    let preparing = Preparing { threads, ..Preparing::default() };
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &preparing).unwrap();
    assert_eq!(plan.settings_found().len(), 1, "processors share a setting");
    let options = Options {
        threads,
        fresh: true,
        on: On::Simulation,
        memory: 1 << 28,
        shot_files: None,
        traces: None,
        viewing: Viewing::None,
        feed: None,
        pulse: false,
    };
    let endings = carry_out(&plan, &project.path("out"), &options, Arc::new(|_| {})).unwrap();
    Results::of(&plan, &endings, On::Simulation).unwrap()
}

#[test]
fn the_error_stays_below_what_was_asked_for() {
    let results = run(1);
    for row in &results.table.rows {
        let number = |column| results.table.number(row, column).unwrap();
        assert!(number("error_l2") <= 0.1, "{row:?}");
        assert!(number("predicted_l2") <= 0.08, "{row:?}");
        assert_eq!(results.table.cell(row, "target_l2"), "0.1");
        // A setting ten times as exact would have been a waste.
        assert!(number("predicted_l2") > 0.02, "{row:?}");
    }
    let one = &results.table.rows[0];
    let [time, predicted] =
        ["time_s", "predicted_time_s"].map(|column| results.table.number(one, column).unwrap());
    assert!((time / predicted - 1.0).abs() < 0.2, "{time} {predicted}");
    assert_eq!(run(2).table, results.table);
}

#[test]
fn knobs_beside_an_accuracy_are_refused() {
    for (more, part) in [
        (r#", "hemisphere": { "pixels": 64 }"#, "stands beside \"accuracy\""),
        (r#", "overshoot": 1.2"#, "expected one of the two"),
    ] {
        let project = Project::new(&experiment(more));
        let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
        let message = plan.err().unwrap().to_string();
        assert!(message.contains(part), "{message}");
    }
    let project = Project::new(&experiment("").replace("0.1", "0"));
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
    assert!(plan.err().unwrap().to_string().contains("expected from 0.0001 to 1"));
}
