//! Finds, checks and runs cases.

use std::path::{Path, PathBuf};

use config::{Document, Fault};

use crate::cases::case::{Case, Overlay};
use crate::checks::measures;
use crate::finding::{Finding, words};
use crate::naive;
use crate::runs::CaseRuns;

/// The result of a case.
pub struct CaseResult {
    /// Name of the case's file, without its ending.
    pub name: String,
    /// The case.
    pub case: Case,
    /// The result of each measure.
    pub findings: Vec<Finding>,
}

impl CaseResult {
    /// Whether all findings are right.
    pub fn holds(&self) -> bool {
        !self.findings.is_empty() && self.findings.iter().all(|finding| finding.holds)
    }
}

/// The case files of a folder, in the order of their names.
///
/// # Errors
/// If the folder does not exist or has no case.
pub fn cases(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let built_in = shipped::json_files(folder);
    if !built_in.is_empty() {
        return Ok(built_in);
    }
    let fault = |message: String| Fault::of_file(folder.display(), message);
    let entries = std::fs::read_dir(folder).map_err(|error| fault(error.to_string()))?;
    let paths = entries.flatten().map(|entry| entry.path());
    let mut paths: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    paths.sort();
    if paths.is_empty() { Err(fault("no case; expected JSON files".to_owned())) } else { Ok(paths) }
}

/// Whether a file is a case: only cases have the field "right".
pub fn is_case(path: &Path) -> bool {
    Document::read(path).is_ok_and(|document| document.value.get("right").is_some())
}

/// Checks a case and its experiment; returns a description for `virtwall check`.
///
/// # Errors
/// The first fault found, unless the case expects the experiment to be refused.
pub fn check(path: &Path) -> Result<String, Fault> {
    let (case, document) = Case::read(path)?;
    match CaseRuns::new(&case, &document, path, &Overlay::new()) {
        Ok(runs) => Ok(format!("a stability case, {} runs", runs.list.len())),
        Err(_) if case.expected.refused.is_some() => {
            Ok("a stability case, to be refused".to_owned())
        }
        Err(fault) => Err(fault),
    }
}

/// Runs a case and compares it with its naive method.
///
/// # Errors
/// A fault of its file, or of its experiment unless the case expects that.
pub fn run_case(path: &Path) -> Result<CaseResult, Fault> {
    let (case, document) = Case::read(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let findings = findings(&case, &document, path)?;
    Ok(CaseResult { name, case, findings })
}

fn findings(case: &Case, document: &Document, path: &Path) -> Result<Vec<Finding>, Fault> {
    let runs = CaseRuns::new(case, document, path, &Overlay::new());
    if let Some(part) = &case.expected.refused {
        let message = match &runs {
            Ok(_) => "accepted".to_owned(),
            // Without the path of the file, which depends on where the case is run.
            Err(fault) => fault.message.clone(),
        };
        return Ok(vec![words("refused", part, message)]);
    }
    let under = |settings| CaseRuns::new(case, document, path, settings);
    let settings = Some(&case.naive_settings).filter(|settings| !settings.is_empty());
    Ok(compare(&runs?, settings.map(under).transpose()?.as_ref()))
}

/// All findings of a case, with those of its naive method: `naive` is the same case under naive settings.
fn compare(runs: &CaseRuns, naive: Option<&CaseRuns>) -> Vec<Finding> {
    let mut found = measures(runs);
    if let Some(naive) = naive {
        for (finding, naive) in found.iter_mut().zip(measures(naive)) {
            finding.naive = (!naive.holds).then_some(naive.ours);
        }
    }
    if let Some(method) = runs.case.naive {
        let finding = found.iter_mut().find(|finding| finding.measure == method.measure());
        finding.into_iter().for_each(|finding| finding.naive = Some(naive::run(method, runs)));
    }
    found
}
