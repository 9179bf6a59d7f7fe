//! Runs side by side, saved one by one, taken up again: always the same results.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::{Project, SWEEP, options};
use lab::{Event, Options, Plan, Preparing, Results, carry_out};

fn plan(project: &Project) -> Plan {
    Plan::read(&project.path("experiments/x.json"), &[], &Preparing::default()).unwrap()
}

/// Carries the plan out; returns the results, and how many runs were found and how many done.
fn carried_out(plan: &Plan, out: &Path, options: &Options) -> (Results, usize, usize) {
    let counts = Arc::new((AtomicUsize::new(0), AtomicUsize::new(0)));
    let watched = Arc::clone(&counts);
    let watch = Arc::new(move |event| match event {
        Event::Found { .. } => _ = watched.0.fetch_add(1, Ordering::Relaxed),
        Event::Finished { .. } => _ = watched.1.fetch_add(1, Ordering::Relaxed),
        Event::Shots { .. } | Event::Counters { .. } | Event::Started { .. } => {}
    });
    let endings = carry_out(plan, out, options, watch).unwrap();
    let results = Results::of(plan, &endings, options).unwrap();
    (results, counts.0.load(Ordering::Relaxed), counts.1.load(Ordering::Relaxed))
}

fn saved(out: &Path) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(out.join(".partial")).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn results_are_the_same_bytes_whatever_runs_side_by_side() {
    let project = Project::new(SWEEP);
    let plan = plan(&project);
    let written = |name: &str, threads| {
        let out = project.path(name);
        carried_out(&plan, &out, &options(threads)).0.write(&out).unwrap();
        let names = ["runs.csv", "manifest.json", "report.html", "speed_up-by-processors.svg"];
        names.map(|name| fs::read(out.join(name)).unwrap())
    };
    let one = written("one", 1);
    assert_eq!(one, written("again", 1));
    assert_eq!(one, written("three", 3));
    assert!(!project.path("one/.partial").exists());
}

#[test]
fn rows_and_columns_follow_the_file() {
    let project = Project::new(SWEEP);
    let (results, ..) = carried_out(&plan(&project), &project.path("out"), &options(2));
    let table = &results.table;
    assert_eq!(
        table.columns[..15].join(","),
        "scene,processors,local_environments,seed,time_s,speed_up,paper_time_s,paper_speed_up,\
         local_shots,received_shots,messages,message_bytes,busy_fraction,energy_error,\
         hemisphere.pixels"
    );
    let runs: Vec<_> = table
        .rows
        .iter()
        .map(|row| (table.cell(row, "processors"), table.cell(row, "hemisphere.pixels")))
        .collect();
    let expected =
        [("1", "64"), ("1", "256"), ("2", "64"), ("2", "256"), ("4", "64"), ("4", "256")];
    assert_eq!(runs, expected);
    for row in &table.rows {
        // Each speed-up is over the run on one processor with as many pixels.
        let one = table.rows.iter().find(|other| {
            table.cell(other, "processors") == "1"
                && table.cell(other, "hemisphere.pixels") == table.cell(row, "hemisphere.pixels")
        });
        let time = |row: &[String]| table.number(row, "time_s").unwrap();
        let expected = time(one.unwrap()) / time(row);
        assert!((table.number(row, "speed_up").unwrap() - expected).abs() < 1e-3);
        assert!(table.number(row, "energy_error").unwrap() <= 1e-9);
    }
}

/// Virtual walls are a sweep as any other; what media absorb is a column where there are any, and part of
/// the balance.
#[test]
fn walls_and_media_can_be_swept() {
    let project = Project::new(
        r#"{ "title": "t", "scene": ["box", "fog"], "processors": 4, "local_environments": 4,
            "hemisphere": { "pixels": 256 }, "mask_bits": [8, 16],
            "interfaces": ["masks", "virtual_walls"],
            "virtual_walls": { "patches": "2x2", "directions": 4 } }"#,
    );
    let fog = r#"{ "obj": "box.obj", "patch_size": "1 m", "cells": "8x4x4", "cuts": {"4": "4x1x1"},
        "media": [{ "min": [0, 0, 0], "max": [4, 2, 1], "absorption": "0.3 /m" }] }"#;
    project.write("scenes/fog.json", fog);
    let (results, ..) = carried_out(&plan(&project), &project.path("out"), &options(1));
    let table = &results.table;
    assert_eq!(table.columns.last().unwrap(), "absorbed_by_media");
    assert_eq!(table.rows.len(), 8);
    for row in &table.rows {
        let number = |name| table.number(row, name).unwrap();
        assert!(number("energy_error") <= 1e-9);
        let fog = table.cell(row, "scene") == "fog";
        assert_eq!(number("absorbed_by_media") > 0.05, fog);
        // Masks of integers take as many bytes as they have bits; walls no more than they hold.
        if table.cell(row, "interfaces") == "masks" {
            let bits = if fog { number("mask_bits") } else { 1.0 };
            assert_eq!(number("message_bytes"), number("messages") * (129.0 + 256.0 * bits / 8.0));
        } else {
            assert!(number("message_bytes") <= number("messages") * (12.0 + 2.0 + 16.0 * 12.0));
        }
    }
}

#[test]
fn a_sweep_goes_on_where_it_was() {
    let project = Project::new(SWEEP);
    let (plan, out) = (plan(&project), project.path("out"));
    let (whole, found, done) = carried_out(&plan, &out, &options(1));
    assert_eq!((found, done), (0, 6));

    // Killed before two of its runs had finished: one left half a file, one left nothing.
    let files = saved(&out);
    fs::remove_file(&files[0]).unwrap();
    let half = fs::read_to_string(&files[1]).unwrap();
    fs::write(&files[1], &half[..half.len() / 2]).unwrap();
    let (resumed, found, done) = carried_out(&plan, &out, &options(2));
    assert_eq!((found, done), (4, 2));
    assert_eq!(resumed.table, whole.table);
    assert_eq!(resumed.manifest, whole.manifest);

    // A figure that was changed in a file is not taken, nor are those of another run.
    let text = fs::read_to_string(&files[2]).unwrap();
    let (before, after) = text.split_once("\"local_shots\":").unwrap();
    let after = after.split_once(',').unwrap().1;
    fs::write(&files[2], format!("{before}\"local_shots\":987654,{after}")).unwrap();
    fs::copy(&files[3], &files[4]).unwrap();
    let (again, found, done) = carried_out(&plan, &out, &options(1));
    assert_eq!((found, done), (4, 2));
    assert_eq!(again.table, whole.table);

    // What others put into the folder is not deleted with the saved runs.
    let foreign = out.join(".partial/notes.json");
    fs::write(&foreign, "mine").unwrap();
    whole.write(&out).unwrap();
    assert_eq!(saved(&out), [foreign]);

    let fresh = Options { fresh: true, ..options(1) };
    assert_eq!(carried_out(&plan, &out, &fresh).1, 0);
}

#[test]
fn what_a_run_depends_on_decides_whether_it_is_saved() {
    let project = Project::new(SWEEP);
    let out = project.path("out");
    let found = || carried_out(&plan(&project), &out, &options(1)).1;
    assert_eq!(found(), 0);
    assert_eq!(found(), 6);
    // Another title is the same runs.
    project.write("experiments/x.json", &SWEEP.replace("\"test\"", "\"other\""));
    assert_eq!(found(), 6);
    // Another value of a sweep leaves the others.
    project.write("experiments/x.json", &SWEEP.replace("256", "257"));
    assert_eq!(found(), 3);
    // Other materials are another scene, another clock another machine.
    let materials = fs::read_to_string(project.path("scenes/box.mtl")).unwrap();
    project.write("scenes/box.mtl", &materials.replace("0.5", "0.4"));
    assert_eq!(found(), 0);
    let machine = fs::read_to_string(project.path("machines/paragon-xps.json")).unwrap();
    project.write("machines/paragon-xps.json", &machine.replace("50 MHz", "60 MHz"));
    assert_eq!(found(), 0);
}

#[test]
fn runs_that_differ_in_one_field_are_saved_apart() {
    let project =
        Project::new(&SWEEP.replace("\"title\"", "\"merge_masks\": [false, true], \"title\""));
    let (plan, out) = (plan(&project), project.path("out"));
    carried_out(&plan, &out, &options(1));
    assert_eq!(saved(&out).len(), plan.runs.len());
}

#[test]
fn the_manifests_experiment_gives_the_same_results() {
    let project = Project::new(SWEEP);
    let (first, ..) = carried_out(&plan(&project), &project.path("one"), &options(1));
    project.write("experiments/x.json", &first.manifest["experiment"].to_string());
    let (second, ..) = carried_out(&plan(&project), &project.path("two"), &options(1));
    assert_eq!(first.table, second.table);
    assert_eq!(first.manifest, second.manifest);
}

#[test]
fn changed_results_are_not_drawn() {
    let project = Project::new(SWEEP);
    let out = project.path("out");
    carried_out(&plan(&project), &out, &options(1)).0.write(&out).unwrap();
    assert_eq!(Results::read(&out).unwrap().sweeps(), ["processors", "hemisphere.pixels"]);
    let csv = fs::read_to_string(out.join("runs.csv")).unwrap();
    fs::write(out.join("runs.csv"), csv.replace("agreed", "greedy")).unwrap();
    let fault = Results::read(&out).err().unwrap().to_string();
    assert!(
        fault
            .ends_with("does not have the digest that manifest.json states; expected it unchanged")
    );
}

#[test]
fn a_run_that_failed_stands_in_its_row_and_the_others_stay_saved() {
    let project = Project::new(SWEEP);
    let (plan, out) = (plan(&project), project.path("out"));
    let options = options(1);
    let mut endings = carry_out(&plan, &out, &options, Arc::new(|_| {})).unwrap();
    endings.runs[0] = Some(Err("nothing under way".to_owned()));
    let results = Results::of(&plan, &endings, &options).unwrap();
    assert_eq!(results.failures(), 1);
    let table = &results.table;
    assert_eq!(table.cell(&table.rows[0], "failure"), "nothing under way");
    // Without the run on one processor there is no speed-up of those with as many pixels.
    let speed_ups: Vec<_> =
        table.rows.iter().map(|row| !table.cell(row, "speed_up").is_empty()).collect();
    assert_eq!(speed_ups, [false, true, false, true, false, true]);
    assert!(results.text().contains("failed: nothing under way\n"), "{}", results.text());
    results.write(&out).unwrap();
    assert!(fs::read_to_string(out.join("report.html")).unwrap().contains("failed: nothing"));
    assert_eq!(saved(&out).len(), 6);
}
