//! A small project in a temporary folder: a box with a lamp, the Paragon, an experiment.

#![allow(dead_code, reason = "not every test uses all")]

use std::fs;
use std::path::{Path, PathBuf};

use lab::{On, Options, Viewing};
use tempfile::TempDir;

/// A project folder that is gone with the test.
pub struct Project {
    folder: TempDir,
}

/// A closed box of 4 × 2 × 2 m, seen from inside, with a lamp under its ceiling.
const BOX: &str = "mtllib box.mtl
v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 2\nv 4 0 2\nv 4 2 2\nv 0 2 2
v 1 1 1.9\nv 1 1.2 1.9\nv 1.2 1.2 1.9\nv 1.2 1 1.9
usemtl wall\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1
usemtl lamp\nf 9 10 11 12\n";
const MATERIALS: &str = "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 100 90 80\n";
const SCENE: &str =
    r#"{ "obj": "box.obj", "patch_size": "1 m", "cells": "8x4x4", "cuts": {"4": "4x1x1"} }"#;

impl Project {
    /// The project, with `experiments/x.json` of this text.
    pub fn new(experiment: &str) -> Project {
        let project = Project { folder: tempfile::tempdir().unwrap() };
        let machine = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/paragon-xps.json");
        project.write("machines/paragon-xps.json", &fs::read_to_string(machine).unwrap());
        project.write("scenes/box.obj", BOX);
        project.write("scenes/box.mtl", MATERIALS);
        project.write("scenes/box.json", SCENE);
        project.write("experiments/x.json", experiment);
        project
    }

    /// The path of a file in the project.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file of the project.
    pub fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
}

/// Simulated runs on `threads` threads, with default options.
pub fn options(threads: usize) -> Options {
    Options {
        threads,
        fresh: false,
        on: On::Simulation,
        memory: 1 << 30,
        shot_files: None,
        traces: None,
        viewing: Viewing::None,
        feed: None,
        counters: false,
    }
}

/// A sweep of four short runs.
#[allow(dead_code, reason = "not every test sweeps")]
pub const SWEEP: &str = r#"{
  "title": "test", "scene": "box", "processors": [1, 2, 4], "local_environments": 4,
  "hemisphere": { "pixels": [64, 256] },
  "plots": [{ "x": "processors", "y": "speed_up" }]
}"#;
