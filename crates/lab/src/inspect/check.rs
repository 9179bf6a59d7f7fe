//! Which kind of file a file is, and whether it is valid.

use std::path::Path;

use config::{Document, Fault, json, read_text};
use multicomputer::{LinkParameters, RouterStages, Trace, Workload};
use radiosity::{load_mtl, read_regular_file};

use crate::engine::simulator;
use crate::files::find::Found;
use crate::inspect::kind::Kind;
use crate::open::machine_file::MachineFile;
use crate::open::scene::{Scene, is_obj};
use crate::planning::plan::Plan;
use crate::planning::preparing::Preparing;

/// What a valid file is.
pub struct Checked {
    /// Its kind, and how large it is.
    pub what: String,
    /// What was corrected in its scenes, and what is odd.
    pub warnings: Vec<String>,
}

impl From<String> for Checked {
    fn from(what: String) -> Checked {
        Checked { what, warnings: Vec::new() }
    }
}

/// Validates an experiment, a machine, a trace, a scene description, an OBJ or an MTL file, with all that
/// it names, and says what it is.
pub fn check(path: &Path) -> Result<Checked, Fault> {
    if is_obj(path) {
        return scene(path, "an OBJ file");
    }
    if is_mtl(path) {
        return materials(path);
    }
    if Workload::is_named(path) {
        return workload(path);
    }
    let text = read_text(path)?;
    if json::without_mark(&text).trim_start().starts_with('[') {
        let file = path.display().to_string();
        let trace = Trace::from_json(&text, &file, usize::MAX).map_err(Fault::complete)?;
        return Ok(format!("a trace, {} messages", trace.messages.len()).into());
    }
    let document = Document::parse(path.display().to_string(), text)?;
    let kind = Kind::of(&document.value);
    if kind == Some(Kind::Experiment) {
        let plan = Plan::read(path, &[], &Preparing { finding: false, ..Preparing::default() })?;
        let (runs, problems) = (plan.runs.len(), plan.problems.len());
        let s = |count| if count == 1 { "" } else { "s" };
        let what = format!(
            "an experiment, {runs} run{} of {problems} problem{} (scene, mesh, cut and hemisphere)",
            s(runs),
            s(problems)
        );
        return Ok(Checked { what, warnings: plan.warnings });
    }
    if kind == Some(Kind::Scene) {
        return scene(path, "a scene");
    }
    if kind == Some(Kind::Machine) {
        let machine = MachineFile::open(&path.display().to_string())?.machine;
        let (compute, service) = (machine.compute_nodes(), machine.service_nodes());
        let what = format!("a machine, {compute} compute nodes and {service} service nodes");
        if machine.processor.cycles.is_empty() {
            return Ok((what + "; it prices no operation, so that it only replays traces").into());
        }
        simulator::check_machine(&machine)
            .map_err(|fault| Fault { file: path.display().to_string(), ..fault })?;
        return Ok(what.into());
    }
    let message = "neither an experiment (\"scene\"), a scene (\"obj\" or \"made\") nor a machine (\"processor\"); \
                   expected one of them, a trace, an OBJ or an MTL file";
    Err(Fault::of_file(path.display(), message))
}

/// A file of messages, for any number of nodes and any links.
fn workload(path: &Path) -> Result<Checked, Fault> {
    let links = LinkParameters {
        bandwidth: 1e9,
        flit_bytes: 1,
        buffer_flits: 1,
        virtual_channels: 1,
        stages: RouterStages::default(),
    };
    let what = match Workload::read(path, usize::MAX, Some(&links))? {
        Workload::Trace(trace) => format!("a trace, {} messages", trace.messages.len()),
        Workload::Schedule(schedule) => {
            format!("a schedule, {} operations", schedule.operations.len())
        }
    };
    Ok(what.into())
}

fn scene(path: &Path, kind: &str) -> Result<Checked, Fault> {
    let found = Found { path: path.to_owned(), label: path.display().to_string() };
    let scene = Scene::load(&found)?;
    let what = format!("{kind}, {} polygons", scene.geometry.polygons.len());
    Ok(Checked { what, warnings: scene.all_warnings().cloned().collect() })
}

/// Whether the name of a file says that it is an MTL file.
fn is_mtl(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtl"))
}

fn materials(path: &Path) -> Result<Checked, Fault> {
    let (materials, warnings) = load_mtl(path, &read_regular_file).map_err(Fault::complete)?;
    let count = materials.len();
    let s = if count == 1 { "" } else { "s" };
    let say = |warning: &radiosity::Warning| format!("{}: {warning}", path.display());
    Ok(Checked {
        what: format!("an MTL file, {count} material{s}"),
        warnings: warnings.iter().map(say).collect(),
    })
}
