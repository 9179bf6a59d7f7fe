//! A name and what it means.

use std::fmt;

/// What a name is the name of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Term {
    /// A model of the network.
    NetworkModel,
    /// A column of runs.csv, or of what plots draw besides.
    Column,
    /// A field of an experiment file.
    ExperimentField,
    /// A field of a machine file; in an experiment it is inside "machine".
    MachineField,
    /// A field of a scene file.
    SceneField,
    /// A choice that the code makes where the paper is silent.
    Choice,
}

/// A name and what it means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What it is the name of.
    pub term: Term,
    /// The name, as files, plots and arguments have it.
    pub name: String,
    /// What it means.
    pub about: String,
    /// Its unit, values, default and so on: what is said, and what it is.
    pub facts: Vec<(&'static str, String)>,
}

impl Entry {
    pub(crate) fn new(term: Term, name: impl Into<String>, about: &str) -> Entry {
        let about = about.split_whitespace().collect::<Vec<_>>().join(" ");
        Entry { term, name: name.into(), about, facts: Vec::new() }
    }

    pub(crate) fn with(mut self, fact: &'static str, value: impl Into<String>) -> Entry {
        self.facts.push((fact, value.into()));
        self
    }

    /// Its first sentence.
    pub fn line(&self) -> &str {
        let ends = self.about.match_indices(". ").map(|(end, _)| end + 1);
        let mut sentences = ends.filter(|&end| !self.about[..end].ends_with("e.g."));
        sentences.next().map_or(&self.about, |end| &self.about[..end])
    }

    /// Where RR-3008 has it: sections, tables and figures that its description names.
    pub fn places(&self) -> Vec<String> {
        let texts = [&self.about].into_iter().chain(self.facts.iter().map(|(_, text)| text));
        let mut places: Vec<String> = texts.flat_map(|text| places(text)).collect();
        places.sort();
        places.dedup();
        places
    }
}

/// The sections, tables and figures that a text names, such as "§4.2.1" and "Table 1".
fn places(text: &str) -> Vec<String> {
    let named = |prefix: &'static str| {
        text.split(prefix).skip(1).filter_map(move |rest| {
            let number = rest.split(|c: char| !c.is_ascii_digit() && c != '.').next()?;
            let number = number.trim_end_matches('.');
            (!number.is_empty()).then(|| format!("{prefix}{number}"))
        })
    };
    ["§", "Table ", "Figure "].into_iter().flat_map(named).collect()
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Term::NetworkModel => "a network model",
            Term::Column => "a column of results",
            Term::ExperimentField => "a field of experiment files",
            Term::MachineField => "a field of machine files",
            Term::SceneField => "a field of scene files",
            Term::Choice => "a choice where the paper is silent",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_the_paper_are_found_in_descriptions() {
        let about = "Tokens (§4.2.4). Paper: §3, Table 1; a §-sign and Figure\n 11.";
        let entry = Entry::new(Term::Column, "x", about).with("default", "one (§4.2.4)");
        assert_eq!(entry.places(), ["Figure 11", "Table 1", "§3", "§4.2.4"]);
        assert_eq!(entry.line(), "Tokens (§4.2.4).");
    }
}
