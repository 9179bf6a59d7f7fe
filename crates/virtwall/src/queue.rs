//! The network queue of a compute node: sources that wait for one of its environments.

use crate::message::Source;
use crate::rules::Selection;

/// Sources received and not yet shot, in order of arrival.
#[derive(Default)]
pub(crate) struct Queue {
    /// With the turn in which each came: a source with its mask, or all bins of a wall patch.
    waiting: Vec<(u64, Vec<Source>)>,
    turns: u64,
}

impl Queue {
    pub(crate) fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Put a source in. With `merge` its mask joins that of the same source, if one waits for the same
    /// environment; else returns its turn. What comes through a wall patch while that waits always does.
    pub(crate) fn push(&mut self, sources: Vec<Source>, merge: bool) -> Option<u64> {
        let merged = self.waiting.iter_mut().find(|(_, other)| joins(other, &sources, merge));
        let Some((_, other)) = merged else {
            self.turns += 1;
            self.waiting.push((self.turns, sources));
            return Some(self.turns);
        };
        for parcel in sources {
            match other.binary_search_by_key(&parcel.emitter.patch, |other| other.emitter.patch) {
                Err(place) => other.insert(place, parcel),
                Ok(place) if parcel.emitter.is_of_a_wall() => {
                    other[place].emitter.power += parcel.emitter.power;
                    other[place].emitter.radiosity += parcel.emitter.radiosity;
                }
                Ok(place) => {
                    other[place].mask.merge(&parcel.mask);
                    other[place].form_factor += parcel.form_factor;
                }
            }
        }
        None
    }

    /// The greatest value that waits, or waits for one environment, and its place; of equals the first to
    /// arrive.
    ///
    /// Choice C13: a received source is worth its emitter's whole energy, however few pixels are
    /// left: that is what the message states.
    pub(crate) fn best(&self, selection: Selection, only: Option<u32>) -> Option<(f64, usize)> {
        let value =
            |source: &Vec<Source>| source.iter().map(|p| selection.value(&p.emitter)).sum::<f64>();
        let asked = |source: &Vec<Source>| {
            only.is_none_or(|only| source.iter().any(|parcel| parcel.environment == only))
        };
        let waiting = (0..).zip(&self.waiting).filter(|(_, (_, source))| asked(source));
        let values = waiting.map(|(place, (_, source))| (value(source), place));
        values.reduce(|best, other| if other.0 > best.0 { other } else { best })
    }

    /// The turns of all that wait.
    pub(crate) fn turns(&self) -> impl Iterator<Item = u64> {
        self.waiting.iter().map(|(turn, _)| *turn)
    }

    /// Take a source out, and tell its turn.
    pub(crate) fn take(&mut self, place: usize) -> (u64, Vec<Source>) {
        self.waiting.remove(place)
    }
}

/// Whether sources that arrive are taken up by one that waits: what a wall patch has gathered by what it
/// had gathered before, a mask by another of the same source if they are to `merge`.
fn joins(waiting: &[Source], sources: &[Source], merge: bool) -> bool {
    let (Some(one), Some(other)) = (waiting.first(), sources.first()) else { return false };
    let (a, b) = (&one.emitter, &other.emitter);
    let same = match (a.is_of_a_wall(), b.is_of_a_wall()) {
        (true, true) => a.centre == b.centre && a.normal == b.normal,
        (false, false) => merge && a == b,
        _ => false,
    };
    same && one.environment == other.environment
}
