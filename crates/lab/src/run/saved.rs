//! Finished runs, each saved in its own file until the sweep is complete, so that a sweep that was killed
//! continues where it stopped.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::engine::figures::Figures;
use crate::engine::simulator::On;
use crate::experiment::fields::Experiment;
use crate::files::digest::{FileDigest, sealed, sha256, unsealed};
use crate::files::file;
use crate::host::host_clock::HostTimes;
use crate::host::program::program;
use crate::planning::plan::{Plan, Run};

/// The folder of finished runs, in that of the results.
pub const FOLDER: &str = ".partial";

pub struct Saved {
    folder: PathBuf,
}

impl Saved {
    pub fn in_folder(out: &Path) -> Saved {
        Saved { folder: out.join(FOLDER) }
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
            speed_up_over: None,
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
        serde_json::from_str(unsealed(key, &text)?).ok()
    }

    pub fn store(&self, key: &str, figures: &Figures, host: HostTimes) -> io::Result<()> {
        file::make_folder(&self.folder)?;
        let text = sealed(key, &serde_json::to_string(&(figures, host))?);
        file::write(&self.path(key), text.as_bytes())
    }

    /// Deletes all finished runs, and the folder if it holds nothing else.
    pub fn forget(&self) -> io::Result<()> {
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if is_saved_run(&entry.file_name().to_string_lossy()) {
                file::remove(&entry.path())?;
            }
        }
        // What others put there stays, and so does the lock of this run.
        let _ = fs::remove_dir(&self.folder);
        Ok(())
    }

    fn path(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.json"))
    }
}

/// Whether a name is that of a saved run, or of one that was being written.
fn is_saved_run(name: &str) -> bool {
    let key = name.split('.').next().unwrap_or_default();
    let hexadecimal = key.len() == 64 && key.bytes().all(|byte| byte.is_ascii_hexdigit());
    hexadecimal && (name.ends_with(".json") || name.ends_with(".tmp"))
}
