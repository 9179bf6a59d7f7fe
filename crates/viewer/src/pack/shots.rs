//! The block of shots, which all runs of a problem share: what each shot hits.

use std::collections::BTreeMap;

use virtwall::{Problem, ShotKey};

use super::Columns;
use crate::record::{LightRecording, RecordedShot};

/// The shots of several runs, without repetitions.
pub(crate) struct Shots<'a> {
    numbers: BTreeMap<ShotKey, u64>,
    shots: Vec<&'a RecordedShot>,
}

impl<'a> Shots<'a> {
    /// The shots of all recordings, numbered in the order of recordings, nodes and times.
    pub fn of(recordings: impl Iterator<Item = &'a LightRecording>) -> Shots<'a> {
        let mut shots = Shots { numbers: BTreeMap::new(), shots: Vec::new() };
        for shot in recordings.flat_map(|recording| recording.shots.iter().flatten()) {
            let number = shots.shots.len() as u64;
            if *shots.numbers.entry(shot.key).or_insert(number) == number {
                shots.shots.push(shot);
            }
        }
        shots
    }

    pub fn number(&self, shot: &RecordedShot) -> u64 {
        self.numbers.get(&shot.key).copied().unwrap_or_default()
    }

    /// All shots as columns. The unit of form factors is a pixel, or 1/256 of a pixel if pixels have different
    /// form factors or media absorb light.
    pub fn columns(&self, problem: &Problem) -> Columns {
        let pixels = f64::from(problem.hemisphere.pixels());
        let whole = |hit: &(u32, f32)| {
            let count = f64::from(hit.1) * pixels;
            (count - count.round()).abs() < 0.01
        };
        let all_whole = self.shots.iter().flat_map(|shot| &shot.hits).all(whole);
        let unit = if all_whole { 1.0 / pixels } else { fine_unit(problem) };
        let mut columns = Columns::default();
        shot_columns(&self.shots, unit, &mut columns);
        columns
    }
}

/// The unit of form factors if pixels have different ones: 1/256 of a pixel.
pub(crate) fn fine_unit(problem: &Problem) -> f64 {
    1.0 / f64::from(problem.hemisphere.pixels()) / 256.0
}

/// What shots hit, with form factors in multiples of `unit`.
pub(crate) fn shot_columns(shots: &[&RecordedShot], unit: f64, columns: &mut Columns) {
    let units = |form_factor: f64| (form_factor / unit).round() as u64;
    columns.floats([unit]);
    columns.ints(shots.iter().map(|shot| u64::from(shot.environment)));
    columns.ints(shots.iter().map(|shot| shot.hits.len() as u64));
    columns.ints(shots.iter().flat_map(|shot| {
        let previous = [0].into_iter().chain(shot.hits.iter().map(|hit| hit.0));
        shot.hits.iter().zip(previous).map(|(hit, previous)| u64::from(hit.0 - previous))
    }));
    columns.ints(shots.iter().flat_map(|shot| shot.hits.iter().map(|hit| units(f64::from(hit.1)))));
    columns.ints(shots.iter().map(|shot| units(shot.backs)));
    columns.ints(shots.iter().map(|shot| units(shot.escaped)));
    columns.ints(shots.iter().map(|shot| units(shot.medium)));
    columns.ints(shots.iter().map(|shot| units(shot.outgoing)));
}
