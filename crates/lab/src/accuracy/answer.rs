//! Answers that runs are compared with: stored references, and dense solutions of the runs' own meshes.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use config::{Document, Fault, read, read_text};
use radiosity::{LocalEnvironment, PatchSize, Rgb, Space};
use reference::{Dense, Difference, NoReference, Patches, Reference};
use virtwall::Problem;

use crate::files::digest::FileDigest;
use crate::files::find::Found;
use crate::host::held::held;

/// The value of the experiment's field that means the dense solution of a run's own mesh.
pub const DENSE: &str = "dense";

/// The value that means the stored reference with the scene's name.
pub const STORED: &str = "stored";

/// Most patches of a dense solution: more take too long and too much memory.
pub const MOST_DENSE: usize = 4_000;

/// Most cells of a stored reference.
const MOST_CELLS: f64 = 4_194_304.0;

/// Largest sum of the errors of a patch's form factors in a dense solution.
const TOLERANCE: f64 = 1e-4;

/// An answer on patches of its own.
pub struct Answer {
    pub patches: Patches,
    /// Their radiosities, W/m².
    pub radiosity: Vec<Rgb>,
    /// Its own error, relative to what is reflected.
    pub error: f64,
}

impl Answer {
    /// Checks that it reflects light, to which errors are relative.
    pub fn check(&self) -> Result<(), String> {
        let Answer { patches, radiosity, .. } = self;
        let light = Difference::between(patches, radiosity, radiosity, radiosity);
        light.map(|_| ()).ok_or_else(dark)
    }
}

/// Why a solution without reflected light is no answer.
pub fn dark() -> String {
    format!("the reference is dark: {}", NoReference::Dark)
}

pub struct Stored {
    pub answer: Arc<Answer>,
    pub digest: FileDigest,
}

impl Stored {
    /// Reads a stored reference of a scene.
    ///
    /// # Errors
    /// If it is no reference, or one of another scene.
    pub fn read(found: &Found, scene: &radiosity::Scene) -> Result<Stored, Fault> {
        let text = read_text(&found.path)?;
        let digest = FileDigest::of(text.as_bytes(), &found.label);
        let document = Document::parse(found.path.display(), text)?;
        let refuse = |message: String| Err(Fault::of_file(found.path.display(), message));
        let stored: Reference = read(&document.value).map_err(|wrong| {
            let message = format!("{}; expected what `reference` has stored", wrong.message);
            document.fault(&wrong.place, message)
        })?;
        let subject = &stored.subject;
        let [reflector, emitter] = [subject.patch_size_m, subject.emitter_patch_size_m];
        let size = PatchSize { reflector, emitter };
        let cells: f64 = subject.cells.iter().map(|&n| f64::from(n)).product();
        if ![reflector, emitter].iter().all(|size| *size > 0.0 && size.is_finite()) || cells == 0.0
        {
            return refuse("no sizes of patches and cells; expected them".to_owned());
        }
        if cells > MOST_CELLS {
            return refuse(format!("{cells} cells; expected at most {MOST_CELLS}"));
        }
        if let Err(error) = size.check(scene) {
            return refuse(error.to_string());
        }
        let space = Space::new(scene.clone(), subject.cells);
        let environment = LocalEnvironment::new(&space, space.grid.whole(), size);
        let patches = Patches::new(&space, &environment);
        if patches.digest() != subject.patches_sha256 || patches.count() != stored.radiosity.len() {
            let message = "is of a scene with other patches than this one's in its mesh; expected \
                           one of the same polygons and materials";
            return refuse(message.to_owned());
        }
        let radiosity = stored.radiosity.iter().map(|&colours| Rgb::from(colours)).collect();
        let answer = Answer { patches, radiosity, error: stored.relative_l2_error };
        if let Err(message) = answer.check() {
            return refuse(message);
        }
        Ok(Stored { answer: Arc::new(answer), digest })
    }
}

/// Dense solutions, each found once.
#[derive(Default)]
pub struct DenseAnswers(Mutex<BTreeMap<String, Arc<OnceLock<Arc<Answer>>>>>);

impl DenseAnswers {
    /// The dense solution on the patches of a problem.
    pub fn of(&self, problem: &Problem) -> Arc<Answer> {
        let patches = Patches::of_all(&problem.space, &problem.environments);
        let place = Arc::clone(held(&self.0).entry(patches.digest()).or_default());
        Arc::clone(place.get_or_init(|| Arc::new(dense(problem, patches))))
    }
}

fn dense(problem: &Problem, patches: Patches) -> Answer {
    let scene = &problem.space.scene;
    let dense = Dense::new(scene, patches, TOLERANCE, parallel::host_threads(), || ());
    let solution = dense.solve();
    let patches = dense.patches().clone();
    // A dark answer is refused before a run is compared with it.
    let error = solution.relative_l2_error(&patches).unwrap_or(f64::INFINITY);
    Answer { radiosity: solution.radiosity, patches, error }
}
