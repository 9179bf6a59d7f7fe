//! Finished runs, each saved in its own file until the sweep is complete, so that a sweep that was killed
//! continues where it stopped.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::engine::figures::Figures;
use crate::engine::simulator::On;
use crate::experiment::fields::Experiment;
use crate::files::digest::{FileDigest, sha256};
use crate::files::file;
use crate::host::host_clock::HostTimes;
use crate::host::program::program;
use crate::planning::plan::{Plan, Run};

pub struct Saved {
    folder: PathBuf,
}

impl Saved {
    pub fn in_folder(out: &Path) -> Saved {
        Saved { folder: out.join(".partial") }
    }

    /// A digest of all that decides a run's figures: the point of the experiment without what only presents
    /// results, the files it reads, and this program.
    pub fn key(&self, plan: &Plan, run: &Run, on: On) -> String {
        let prepared = &plan.problems[run.problem];
        let digests = |files: &[FileDigest]| -> Vec<String> {
            files.iter().map(|file| file.sha256.clone()).collect()
        };
        let point = Experiment {
            schema: None,
            title: String::new(),
            compare_with: None,
            plots: Vec::new(),
            ..run.point.clone()
        };
        let conditions = json!({
            "program": program(),
            "on": on,
            "scene": digests(&prepared.digests),
            "settings": prepared.settings,
            "reference": run.stored.map(|stored| &plan.references[stored].digest.sha256),
            "machine": digests(&plan.machines[run.machine].digests),
            "point": point,
        });
        sha256(conditions.to_string().as_bytes())
    }

    /// The figures and host times of the run with this key, if it was finished. A damaged file counts as
    /// missing.
    pub fn load(&self, key: &str) -> Option<(Figures, HostTimes)> {
        let text = fs::read_to_string(self.path(key)).ok()?;
        serde_json::from_str(&text).ok()
    }

    pub fn store(&self, key: &str, figures: &Figures, host: HostTimes) -> io::Result<()> {
        fs::create_dir_all(&self.folder)?;
        file::write(&self.path(key), &serde_json::to_vec(&(figures, host))?)
    }

    pub fn forget(&self) -> io::Result<()> {
        match fs::remove_dir_all(&self.folder) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        }
    }

    fn path(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.json"))
    }
}
