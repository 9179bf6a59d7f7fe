//! Columns of errors, and the stored references that runs are compared with.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::fs;
use std::sync::Arc;

use common::{Project, options};
use lab::{OpenScene, Options, Plan, Preparing, Results, carry_out};
use radiosity::{LocalEnvironment, PatchSize, Space};
use reference::{Dense, Method, Patches, Problem, Reference, Subject};

const STORED: &str = "results/references/box.json";

fn experiment(more: &str) -> String {
    format!(
        r#"{{ "title": "t", "scene": "box", "processors": 1, "local_environments": 1,
            "hemisphere": {{ "pixels": [64, 4096] }}, "stop": {{ "patch_threshold": "0.01 %" }}{more} }}"#
    )
}

/// A project with the dense solution of its scene as a stored reference, changed by `change`.
fn project(change: impl Fn(&mut Reference)) -> Project {
    let project = Project::new(&experiment(r#", "reference": "stored", "error_causes": true"#));
    let open = OpenScene::load(project.path("scenes/box.json").to_str().unwrap()).unwrap();
    let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
    let space = Space::new(open.scene, open.cells);
    let environment = LocalEnvironment::new(&space, space.grid.whole(), size);
    let patches = Patches::new(&space, &environment);
    let subject = Subject {
        scene: "box".to_owned(),
        patches_sha256: patches.digest(),
        patch_size_m: open.patch_size,
        emitter_patch_size_m: open.emitter_patch_size,
        cells: open.cells,
        problem: Problem::Patches,
        method: Method::Dense { tolerance: 1e-4 },
    };
    let dense = Dense::new(&space.scene, patches.clone(), 1e-4, 1, || ());
    let mut reference = Reference::new(subject, &patches, &dense.solve()).unwrap();
    change(&mut reference);
    project.write(STORED, &serde_json::to_string(&reference).unwrap());
    project
}

fn run(project: &Project) -> Results {
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default()).unwrap();
    let options = Options { fresh: true, memory: 1 << 28, ..options(1) };
    let endings = carry_out(&plan, &project.path("out"), &options, Arc::new(|_| {})).unwrap();
    Results::of(&plan, &endings, &options).unwrap()
}

#[test]
fn errors_are_told_and_taken_apart() {
    let project = project(|_| ());
    let stored = run(&project);
    let number = |results: &Results, row: usize, column: &str| {
        results.table.number(&results.table.rows[row], column).unwrap()
    };
    for row in [0, 1] {
        let [l2, most, own] =
            ["error_l2", "error_max", "reference_error"].map(|column| number(&stored, row, column));
        assert!(0.0 < own && own < 1e-3 && own < l2 && l2 < most, "{row}: {own} {l2} {most}");
        let causes = ["stopping", "directions", "sampling", "mesh"]
            .map(|cause| number(&stored, row, &format!("error_{cause}")));
        let sum: f64 = causes.iter().sum();
        assert!(l2 <= sum * 1.000_001, "{row}: {l2} of {causes:?}");
        // The reference is of the run's own mesh, and the mask as fine as the hemisphere.
        assert!(causes[3] < 1e-3, "{causes:?}");
    }
    assert!(number(&stored, 0, "error_directions") > 8.0 * number(&stored, 1, "error_directions"));
    // The dense solution that a run finds for itself is the stored one.
    project.write("experiments/x.json", &experiment(r#", "reference": "dense""#));
    let dense = run(&project);
    assert!(!dense.table.columns.iter().any(|column| column == "error_mesh"));
    for row in [0, 1] {
        let ratio = number(&dense, row, "error_l2") / number(&stored, row, "error_l2");
        assert!((ratio - 1.0).abs() < 1e-2, "{row}: {ratio}");
    }
}

/// An experiment that is compared with a dense solution of a scene that emits or reflects nothing is refused.
#[test]
fn a_scene_without_light_has_no_answer() {
    let project = project(|_| ());
    project.write("experiments/x.json", &experiment(r#", "reference": "dense""#));
    for materials in ["newmtl wall\nKd 0 0 0\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n", "newmtl wall\n"] {
        project.write("scenes/box.mtl", materials);
        let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
        let message = plan.err().unwrap().to_string();
        assert!(message.contains("reference: the reference is dark"), "{message}");
    }
}

/// A run that is compared with a dense solution without light fails: its error is not 0.
#[test]
fn an_error_relative_to_no_light_is_an_error() {
    let project = project(|_| ());
    project.write("experiments/x.json", &experiment(r#", "reference": "dense""#));
    // Only the lamp reflects, and nothing sends light back to it.
    let materials = "newmtl wall\nKd 0 0 0\nnewmtl lamp\nKd 0.5 0.5 0.5\nKe 9 9 9\n";
    project.write("scenes/box.mtl", materials);
    let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default()).unwrap();
    let options = Options { fresh: true, memory: 1 << 28, ..options(1) };
    let endings = carry_out(&plan, &project.path("out"), &options, Arc::new(|_| {})).unwrap();
    let results = Results::of(&plan, &endings, &options).unwrap();
    let (table, row) = (&results.table, &results.table.rows[0]);
    assert_eq!(table.cell(row, "error_l2"), "");
    assert_eq!(results.failures(), 2);
}

#[test]
fn references_that_do_not_fit_are_refused() {
    let good = || project(|_| ());
    let other_scene = good();
    let path = other_scene.path("scenes/box.mtl");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("Kd 0.5 0.5 0.5", "Kd 0.5 0.4 0.5")).unwrap();
    let moved = good();
    let path = moved.path("scenes/box.obj");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace("1.9", "1.8")).unwrap();
    let (unreadable, missing) = (good(), good());
    unreadable.write(STORED, "{}");
    fs::remove_file(missing.path(STORED)).unwrap();
    let patches = "references/box.json: is of a scene with other patches than this one's";
    for (project, expected) in [
        (other_scene, patches),
        (moved, patches),
        (project(|reference| reference.subject.patch_size_m *= 0.5), patches),
        (project(|reference| reference.subject.patches_sha256 = "00".to_owned()), patches),
        (project(|reference| _ = reference.radiosity.pop()), patches),
        (project(|reference| reference.subject.cells = [0, 1, 1]), "no sizes of patches and cells"),
        // A mesh that no memory holds is refused before it is made.
        (project(|reference| reference.subject.patch_size_m = 1e-6), "patches"),
        (project(|reference| reference.subject.emitter_patch_size_m = 1e-9), "patches"),
        (
            project(|reference| reference.subject.cells = [16_384, 16_384, 1]),
            "cells; expected at most",
        ),
        (project(|reference| reference.subject.cells = [u32::MAX; 3]), "cells; expected at most"),
        (
            project(|reference| {
                let reflecting = reference.radiosity.iter_mut().filter(|patch| patch[0] < 99.0);
                reflecting.for_each(|patch| *patch = [0.0; 3]);
            }),
            "the reference is dark",
        ),
        (unreadable, "expected what `reference` has stored"),
        (missing, "reference: unknown reference \"box\""),
    ] {
        let plan = Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default());
        let message = plan.err().unwrap().to_string();
        assert!(message.contains(expected), "{message}");
    }
}
