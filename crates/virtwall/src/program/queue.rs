//! The network queue of a compute node: sources that wait for one of its environments.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::rules::Selection;
use crate::problem::Source;

/// The number of a queued source, by order of arrival.
pub type Turn = u64;

/// Sources received and not yet shot. All operations take logarithmic time.
pub struct Queue {
    selection: Selection,
    merge_masks: bool,
    waiting: BTreeMap<Turn, Box<Source>>,
    /// By environment: values, as bits, with turns, in rising order. Of equal values the first to arrive is
    /// last.
    by_value: BTreeMap<u32, BTreeSet<(u64, Reverse<Turn>)>>,
    /// By environment and emitter: the source with which one that arrives may be merged.
    by_emitter: BTreeMap<(u32, u32, u32), Vec<Turn>>,
    turns: Turn,
}

impl Queue {
    /// An empty queue; with `merge_masks`, masks of one source for one environment are merged.
    pub fn new(selection: Selection, merge_masks: bool) -> Queue {
        Queue {
            selection,
            merge_masks,
            waiting: BTreeMap::new(),
            by_value: BTreeMap::new(),
            by_emitter: BTreeMap::new(),
            turns: 0,
        }
    }

    /// The number of sources that wait.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// The sources that wait, in order of arrival.
    pub fn turns(&self) -> impl Iterator<Item = Turn> {
        self.waiting.keys().copied()
    }

    /// Put a source in. Returns its turn, or `None` if it was merged with a source that waits. Sources from a
    /// wall patch are always merged with those of the same bin.
    pub fn push(&mut self, source: Box<Source>) -> Option<Turn> {
        let emitter = emitter_of(&source);
        let waiting = self.by_emitter.get(&emitter).into_iter().flatten();
        let same = waiting.copied().find(|turn| {
            source.emitter.is_of_a_wall()
                || self.merge_masks && are_of_one_shot(&self.waiting[turn], &source)
        });
        match same {
            Some(turn) => {
                let mut merged = self.take(turn);
                merge(&mut merged, &source);
                self.insert(turn, merged);
                None
            }
            None => {
                self.turns += 1;
                self.insert(self.turns, source);
                Some(self.turns)
            }
        }
    }

    fn may_merge(&self, source: &Source) -> bool {
        self.merge_masks || source.emitter.is_of_a_wall()
    }

    fn insert(&mut self, turn: Turn, source: Box<Source>) {
        let place = self.place(turn, &source);
        self.by_value.entry(source.environment).or_default().insert(place);
        if self.may_merge(&source) {
            self.by_emitter.entry(emitter_of(&source)).or_default().push(turn);
        }
        self.waiting.insert(turn, source);
    }

    fn place(&self, turn: Turn, source: &Source) -> (u64, Reverse<Turn>) {
        // Values are not negative, so that their bits are in the same order.
        (self.selection.value(&source.emitter).to_bits(), Reverse(turn))
    }

    /// The source of a turn.
    ///
    /// # Panics
    /// If it does not wait.
    pub fn get(&self, turn: Turn) -> &Source {
        &self.waiting[&turn]
    }

    /// The greatest value that waits, for any environment or for one, with its turn. Of equal values, the first
    /// to arrive.
    ///
    /// Choice C13: a received source is worth its emitter's whole energy, however few pixels are left:
    /// that is what the message states.
    pub fn best(&self, only: Option<u32>) -> Option<(f64, Turn)> {
        let environments = match only {
            Some(only) => self.by_value.range(only..=only),
            None => self.by_value.range(..),
        };
        let bests = environments.filter_map(|(_, values)| values.last());
        bests.max().map(|&(value, Reverse(turn))| (f64::from_bits(value), turn))
    }

    /// Take a source out.
    ///
    /// # Panics
    /// If it does not wait.
    pub fn take(&mut self, turn: Turn) -> Box<Source> {
        let source = self.waiting.remove(&turn).expect("the source of this turn waits");
        let place = self.place(turn, &source);
        remove(&mut self.by_value, &source.environment, |values| {
            values.remove(&place);
            values.is_empty()
        });
        if self.may_merge(&source) {
            remove(&mut self.by_emitter, &emitter_of(&source), |turns| {
                turns.retain(|&other| other != turn);
                turns.is_empty()
            });
        }
        source
    }
}

/// Change an entry, and remove it if nothing is left of it.
fn remove<K: Ord, V>(map: &mut BTreeMap<K, V>, key: &K, change: impl FnOnce(&mut V) -> bool) {
    if map.get_mut(key).is_some_and(change) {
        map.remove(key);
    }
}

/// The environment that a source is for, and its emitter's environment and number.
fn emitter_of(source: &Source) -> (u32, u32, u32) {
    (source.environment, source.emitter.environment, source.emitter.patch)
}

/// Whether two sources of a patch are parts of one shot. A shot of a cut patch has several emitters.
fn are_of_one_shot(a: &Source, b: &Source) -> bool {
    a.shot == b.shot && a.emitter == b.emitter
}

/// Add a source to another of the same emitter: power to power on a virtual wall, else mask to mask.
fn merge(waiting: &mut Source, source: &Source) {
    if source.emitter.is_of_a_wall() {
        waiting.emitter.power += source.emitter.power;
        waiting.emitter.radiosity += source.emitter.radiosity;
    } else {
        waiting.mask.merge(&source.mask);
        waiting.form_factor += source.form_factor;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use radiosity::glam::DVec3;
    use radiosity::{Emitter, Mask, Rgb};

    use super::*;

    /// The slow, obvious queue: a list that is searched whole.
    #[derive(Default)]
    struct List(Vec<(Turn, Source)>, Turn);

    impl List {
        fn push(&mut self, source: Source, merge_masks: bool) -> Option<Turn> {
            let same = |other: &Source| {
                merge_masks
                    && other.environment == source.environment
                    && other.emitter == source.emitter
                    && other.shot == source.shot
            };
            if let Some((_, waiting)) = self.0.iter_mut().find(|(_, other)| same(other)) {
                merge(waiting, &source);
                return None;
            }
            self.1 += 1;
            self.0.push((self.1, source));
            Some(self.1)
        }

        fn best(&self, only: Option<u32>) -> Option<(f64, Turn)> {
            let asked = |source: &Source| only.is_none_or(|only| source.environment == only);
            let waiting = self.0.iter().filter(|(_, source)| asked(source));
            let values = waiting.map(|(turn, s)| (Selection::Energy.value(&s.emitter), *turn));
            values.reduce(|best, other| if other.0 > best.0 { other } else { best })
        }

        fn take(&mut self, turn: Turn) -> Source {
            let place = self.0.iter().position(|(other, _)| *other == turn).unwrap();
            self.0.remove(place).1
        }
    }

    fn source(environment: u32, patch: u32, shot: u32, pixel: u32) -> Source {
        let mut mask = Mask::none(64);
        mask.set(pixel);
        let emitter = Emitter {
            environment: 9,
            patch,
            polygon: 0,
            centre: DVec3::ZERO,
            normal: DVec3::Z,
            power: Rgb::splat(f64::from(shot % 3)),
            radiosity: Rgb::splat(f64::from(shot % 3)),
        };
        Source { environment, shot, emitter, mask, form_factor: 1.0 / 64.0 }
    }

    proptest! {
        #[test]
        fn it_is_a_list_that_is_searched(
            merge_masks: bool,
            // Environment, patch, shot, pixel; then which one to take, if any. Different shots may have equal power.
            steps in proptest::collection::vec(
                ((0u32..3, 0u32..3, 0u32..5, 0u32..64), proptest::option::of(0u32..4)), 1..60),
        ) {
            let (mut queue, mut list) = (Queue::new(Selection::Energy, merge_masks), List::default());
            for ((environment, patch, shot, pixel), take) in steps {
                let source = source(environment, patch, shot, pixel);
                prop_assert_eq!(queue.push(Box::new(source.clone())), list.push(source, merge_masks));
                // 3 stands for any environment.
                if let Some(only) = take {
                    let only = Some(only).filter(|&only| only < 3);
                    let best = queue.best(only);
                    prop_assert_eq!(best, list.best(only));
                    if let Some((_, turn)) = best {
                        prop_assert_eq!(*queue.take(turn), list.take(turn));
                    }
                }
                let turns: Vec<_> = list.0.iter().map(|(turn, _)| *turn).collect();
                prop_assert_eq!(queue.turns().collect::<Vec<_>>(), turns);
            }
        }
    }
}
