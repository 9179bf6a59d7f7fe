//! All cases of a folder, tried.

use std::path::{Path, PathBuf};

use lab::{Document, Fault};

use crate::bench::Bench;
use crate::case::{Case, Overlay};
use crate::finding::{Finding, words};
use crate::measures::findings;

/// What came of a case.
pub struct Verdict {
    /// Name of the case's file, without its ending.
    pub name: String,
    /// The case.
    pub case: Case,
    /// What was found.
    pub findings: Vec<Finding>,
}

impl Verdict {
    /// Whether all is right.
    pub fn holds(&self) -> bool {
        !self.findings.is_empty() && self.findings.iter().all(|finding| finding.holds)
    }
}

/// The case files of a folder, by name.
///
/// # Errors
/// If there is no such folder, or no case in it.
pub fn cases(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let fault = |message: String| Fault::of_file(folder.display(), message);
    let entries = std::fs::read_dir(folder).map_err(|error| fault(error.to_string()))?;
    let paths = entries.flatten().map(|entry| entry.path());
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    paths.sort();
    if paths.is_empty() { Err(fault("no case; expected JSON files".to_owned())) } else { Ok(paths) }
}

/// Whether a file is a case rather than anything else.
pub fn is_case(path: &Path) -> bool {
    Document::read(path).is_ok_and(|document| document.value.get("right").is_some())
}

/// Validates a case with its experiment, and says what it is.
///
/// # Errors
/// The first fault met, unless it is right to refuse the experiment.
pub fn check(path: &Path) -> Result<String, Fault> {
    let (case, document) = Case::read(path)?;
    match Bench::new(&case, &document, path, &Overlay::new()) {
        Ok(bench) => Ok(format!("a stability case, {} runs", bench.trials.len())),
        Err(_) if case.right.refused.is_some() => Ok("a stability case, to be refused".to_owned()),
        Err(fault) => Err(fault),
    }
}

/// Tries a case.
///
/// # Errors
/// A fault of its file, or of its experiment unless it is right to refuse that.
pub fn try_case(path: &Path) -> Result<Verdict, Fault> {
    let (case, document) = Case::read(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let findings = found(&case, &document, path)?;
    Ok(Verdict { name, case, findings })
}

fn found(case: &Case, document: &Document, path: &Path) -> Result<Vec<Finding>, Fault> {
    let bench = Bench::new(case, document, path, &Overlay::new());
    if let Some(part) = &case.right.refused {
        let message = match &bench {
            Ok(_) => "accepted".to_owned(),
            // Where the file lies is no matter of the case's.
            Err(fault) => fault.message.clone(),
        };
        return Ok(vec![words("refused", part, message)]);
    }
    let naive = match case.naive_settings.is_empty() {
        true => None,
        false => Some(Bench::new(case, document, path, &case.naive_settings)?),
    };
    Ok(findings(&bench?, naive.as_ref()))
}
