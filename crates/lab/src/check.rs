//! What a file is, and whether it is right.

use std::path::Path;

use crate::document::Document;
use crate::engine;
use crate::fault::Fault;
use crate::find::Found;
use crate::plan::Plan;
use crate::scene::Scene;

/// Validates an experiment, a machine, a scene description or an OBJ file, with all that it
/// names, and says what it is.
///
/// # Errors
/// The first fault met.
pub fn check(path: &Path) -> Result<String, Fault> {
    if path.extension().is_some_and(|ending| ending == "obj") {
        return scene(path, "an OBJ file");
    }
    let document = Document::read(path)?;
    let has = |key: &str| document.value.get(key).is_some();
    if has("scene") || has("plots") {
        let plan = Plan::read(path, &[])?;
        let (runs, problems) = (plan.runs.len(), plan.problems.len());
        return Ok(format!("an experiment, {runs} runs of {problems} meshed scenes"));
    }
    if has("obj") || has("made") {
        return scene(path, "a scene");
    }
    if has("processor") || has("network") {
        let machine = engine::load_machine(path)?;
        let nodes = (machine.compute_nodes(), machine.service_nodes());
        return Ok(format!("a machine, {} compute nodes and {} service nodes", nodes.0, nodes.1));
    }
    let message = "neither an experiment (\"scene\"), a scene (\"obj\" or \"made\") nor a machine (\"processor\"); \
                   expected one of them, or an OBJ file";
    Err(Fault::of_file(path.display(), message))
}

fn scene(path: &Path, kind: &str) -> Result<String, Fault> {
    let found = Found { path: path.to_owned(), label: path.display().to_string() };
    let scene = Scene::load(&found)?;
    let warnings = scene.warnings.iter().map(|warning| format!("\n  warning: {warning}"));
    let polygons = scene.geometry.polygons.len();
    Ok(format!("{kind}, {polygons} polygons{}", warnings.collect::<String>()))
}
