//! The machines of a sweep: each file is read once, each changed machine built once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use config::{Fault, Place};

use crate::engine::simulator;
use crate::experiment::machine::MachineChoice;
use crate::files::find::{FileKind, find};
use crate::open::machine_file::MachineFile;
use crate::planning::plan::Equipment;

/// The most different machines of an experiment: each is built before the first run.
pub const MOST_MACHINES: usize = 1_000;

#[derive(Default)]
pub struct Machines {
    /// All of them, in the order in which points name them first.
    pub read: Vec<Equipment>,
    /// Indices into `read`, by what the experiment says of the machine.
    known: BTreeMap<String, usize>,
    files: BTreeMap<PathBuf, MachineFile>,
}

impl Machines {
    /// The index of the machine that an experiment in `folder` chooses; `fault` makes a fault at a place of that
    /// experiment.
    pub fn find(
        &mut self,
        folder: &Path,
        choice: &MachineChoice,
        fault: impl Fn(Place, String) -> Fault,
    ) -> Result<usize, Fault> {
        let key = serde_json::to_string(choice).unwrap_or_default();
        if let Some(&known) = self.known.get(&key) {
            return Ok(known);
        }
        if self.read.len() == MOST_MACHINES {
            let message = format!("more than {MOST_MACHINES} different machines; expected fewer");
            return Err(fault(Place::of("machine"), message));
        }
        let changes = choice.changes();
        let field = if changes.is_some() { "machine.extends" } else { "machine" };
        let found = find(folder, &FileKind::MACHINES, choice.name())
            .map_err(|message| fault(Place::of(field), message))?;
        let file = match self.files.get(&found.path) {
            Some(file) => file,
            None => {
                let file = MachineFile::load(&found)?;
                self.files.entry(found.path.clone()).or_insert(file)
            }
        };
        let machine = match &changes {
            None => Ok(file.machine.clone()),
            Some(changes) => file.changed(changes.clone()),
        };
        let checked = machine.and_then(|machine| {
            simulator::check_machine(&machine)?;
            Ok(machine)
        });
        let machine = checked.map_err(|wrong| match changes {
            None => Fault { file: found.path.display().to_string(), ..wrong },
            Some(_) => fault(choice.place(&wrong.place), wrong.message),
        })?;
        self.read.push(Equipment { machine, digests: file.digests.clone() });
        self.known.insert(key, self.read.len() - 1);
        Ok(self.read.len() - 1)
    }
}
