//! The network queue of a compute node: sources that wait for one of its environments.

use crate::message::Parcel;
use crate::rules::Selection;

/// Sources received and not yet shot, in order of arrival.
#[derive(Default)]
pub(crate) struct Queue {
    /// With the turn in which each came.
    waiting: Vec<(u64, Parcel)>,
    turns: u64,
}

impl Queue {
    pub(crate) fn len(&self) -> usize {
        self.waiting.len()
    }

    /// Put a parcel in. With `merge` its mask joins that of a parcel from the same shot, if one
    /// waits for the same environment; else returns its turn.
    pub(crate) fn push(&mut self, parcel: Parcel, merge: bool) -> Option<u64> {
        let same = |(_, other): &&mut (u64, Parcel)| {
            other.environment == parcel.environment && other.source == parcel.source
        };
        let merged = self.waiting.iter_mut().find(|other| merge && same(other));
        let Some((_, other)) = merged else {
            self.turns += 1;
            self.waiting.push((self.turns, parcel));
            return Some(self.turns);
        };
        other.mask.merge(&parcel.mask);
        other.form_factor += parcel.form_factor;
        None
    }

    /// The greatest value that waits, and its place; of equals the first to arrive.
    ///
    /// Choice C13: a received source is worth its emitter's whole energy, however few pixels are
    /// left: that is what the message states.
    pub(crate) fn best(&self, selection: Selection) -> Option<(f64, usize)> {
        let values = self.waiting.iter().map(|(_, parcel)| selection.value(&parcel.source));
        values.zip(0..).reduce(|best, other| if other.0 > best.0 { other } else { best })
    }

    /// The turns of all that wait.
    pub(crate) fn turns(&self) -> impl Iterator<Item = u64> {
        self.waiting.iter().map(|(turn, _)| *turn)
    }

    /// Take a parcel out, and tell its turn.
    pub(crate) fn take(&mut self, place: usize) -> (u64, Parcel) {
        self.waiting.remove(place)
    }
}
