//! All names that mean something, and those that a word means.

use config::distance;

use crate::glossary::choices::choices;
use crate::glossary::entry::{Entry, Term};
use crate::glossary::fields::{ANY, fields, network_models};
use crate::table::columns;

/// Most names that are suggested for an unknown word.
const SUGGESTIONS: usize = 5;

/// Everything that can be explained: network models, columns, fields, choices.
pub fn glossary() -> Vec<Entry> {
    let columns = columns::explained()
        .map(|(name, unit, about)| Entry::new(Term::Column, name, about).with("unit", unit));
    network_models().into_iter().chain(columns).chain(fields()).chain(choices()).collect()
}

/// What a word means: each entry of that name.
///
/// # Errors
/// The nearest names, if there is no such entry.
pub fn explain(word: &str) -> Result<Vec<Entry>, Vec<String>> {
    let all = glossary();
    let named = all.iter().filter(|entry| means(entry, word));
    let mut found: Vec<Entry> = named.cloned().collect();
    // A name that is spelled out goes before one that could be any.
    if found.iter().any(|entry| entry.name == word) {
        found.retain(|entry| entry.name == word);
    }
    if found.is_empty() { Err(nearest(word, &all)) } else { Ok(found) }
}

/// Whether an entry is what a word means. In an experiment, fields of a machine are inside "machine".
fn means(entry: &Entry, word: &str) -> bool {
    match entry.term {
        Term::Choice => entry.name.eq_ignore_ascii_case(word),
        Term::MachineField => fits(&entry.name, word.strip_prefix("machine.").unwrap_or(word)),
        _ => fits(&entry.name, word),
    }
}

fn fits(name: &str, word: &str) -> bool {
    let (mut names, mut words) = (name.split('.'), word.split('.'));
    loop {
        match (names.next(), words.next()) {
            (None, None) => return true,
            (Some(name), Some(word)) if name == word || name == ANY && !word.is_empty() => {}
            _ => return false,
        }
    }
}

/// The names nearest to a word: by their letters, then by those of their last parts, then those that contain it.
fn nearest(word: &str, all: &[Entry]) -> Vec<String> {
    let near = |name: &str| {
        let last = name.rsplit('.').next().filter(|_| !word.is_empty() && !word.contains('.'));
        let whole = distance(word, name).filter(|_| !word.is_empty()).map(|letters| (0, letters));
        let part = || Some((1, distance(word, last?)?));
        let inside = || (word.len() > 2 && name.contains(word)).then_some((2, name.len()));
        whole.or_else(part).or_else(inside)
    };
    let near = |entry: &Entry| Some((near(&entry.name)?, entry.name.clone()));
    let mut near: Vec<((u8, usize), String)> = all.iter().filter_map(near).collect();
    near.sort();
    near.dedup();
    near.into_iter().take(SUGGESTIONS).map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_means_each_entry_of_its_name() {
        let terms = |word: &str| -> Vec<Term> {
            explain(word).unwrap().into_iter().map(|entry| entry.term).collect()
        };
        assert_eq!(terms("time_s"), [Term::Column]);
        assert_eq!(terms("scene"), [Term::Column, Term::ExperimentField]);
        assert_eq!(terms("stop.patch_threshold"), [Term::ExperimentField]);
        assert_eq!(terms("machine.network.links.bandwidth"), [Term::MachineField]);
        assert_eq!(terms("processor.operations.ray"), [Term::MachineField]);
        assert_eq!(terms("plots.log_x"), [Term::ExperimentField]);
        assert_eq!(terms("cuts.56"), [Term::SceneField]);
        assert_eq!(terms("c12"), [Term::Choice]);
        assert_eq!(terms("wormhole"), [Term::NetworkModel]);
        for (word, nearest) in [
            ("patch_threshold", "stop.patch_threshold"),
            ("stop.pach_threshold", "stop.patch_threshold"),
            ("tiem_s", "time_s"),
            ("threshold", "stop.patch_threshold"),
        ] {
            assert!(explain(word).unwrap_err().iter().any(|name| name == nearest), "{word}");
        }
        assert_eq!(explain("operations.rays").unwrap_err()[0], "operations.ray");
        assert_eq!(explain("xyzzyxyzzy"), Err(Vec::new()));
        assert_eq!(explain(""), Err(Vec::new()));
    }
}
