//! What was found.

/// Rays that are wrong, of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Count {
    /// Wrong ones.
    pub wrong: u64,
    /// All.
    pub of: u64,
}

impl Count {
    /// Both added.
    pub fn and(self, other: Count) -> Count {
        Count { wrong: self.wrong + other.wrong, of: self.of + other.of }
    }
}

/// What was found, as it is told.
#[derive(Clone, Debug, PartialEq)]
pub enum Said {
    /// Wrong ones of all.
    Count(Count),
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// Words.
    Words(String),
}

impl Said {
    /// How wrong, as a share; none for words.
    pub fn share(&self) -> Option<f64> {
        match self {
            Said::Count(Count { of: 0, .. }) | Said::Words(_) | Said::Whole(_) => None,
            Said::Count(Count { wrong, of }) => Some(*wrong as f64 / *of as f64),
            Said::Number(number) => Some(*number),
        }
    }
}

/// What was found by one measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The measure's name.
    pub measure: &'static str,
    /// What is right.
    pub bound: Said,
    /// Ours.
    pub ours: Said,
    /// The naive method's; of this program under naive settings, only what is not right.
    pub naive: Option<Said>,
    /// Whether ours is right.
    pub holds: bool,
}

/// Wrong ones, of which there are at most so many.
pub fn count(measure: &'static str, most: u64, ours: Count) -> Finding {
    let bound = Said::Count(Count { wrong: most, of: ours.of });
    let holds = ours.wrong <= most && ours.of > 0;
    Finding { measure, bound, ours: Said::Count(ours), naive: None, holds }
}

/// A number that is at most so much.
pub fn number(measure: &'static str, most: f64, ours: Result<f64, String>) -> Finding {
    let holds = ours.as_ref().is_ok_and(|&ours| ours <= most);
    let ours = ours.map_or_else(Said::Words, Said::Number);
    Finding { measure, bound: Said::Number(most), ours, naive: None, holds }
}

/// A whole number that must be what it is.
pub fn whole(measure: &'static str, exactly: u64, ours: Result<u64, String>) -> Finding {
    let holds = ours == Ok(exactly);
    let ours = ours.map_or_else(Said::Words, Said::Whole);
    Finding { measure, bound: Said::Whole(exactly), ours, naive: None, holds }
}

/// Words, a part of which must be there.
pub fn words(measure: &'static str, part: &str, ours: String) -> Finding {
    let holds = ours.contains(part);
    Finding {
        measure,
        bound: Said::Words(part.to_owned()),
        ours: Said::Words(ours),
        naive: None,
        holds,
    }
}
