//! Measured quantities and the bounds they are compared with.

/// Quantities below this are rounding errors. Results show them as less than this, since another compiler
/// may give other values.
pub const ROUNDING: f64 = 1e-12;

/// How many of a number of rays or patches are wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Count {
    pub wrong: u64,
    pub of: u64,
}

impl Count {
    pub fn and(self, other: Count) -> Count {
        Count { wrong: self.wrong + other.wrong, of: self.of + other.of }
    }
}

/// A measured quantity, or a bound.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// Wrong ones among all.
    Count(Count),
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// Words.
    Words(String),
}

impl Quantity {
    /// The quantity as a share; `None` for whole numbers and words.
    pub fn share(&self) -> Option<f64> {
        match self {
            Quantity::Count(Count { of: 0, .. }) | Quantity::Words(_) | Quantity::Whole(_) => None,
            Quantity::Count(Count { wrong, of }) => Some(*wrong as f64 / *of as f64),
            Quantity::Number(number) => Some(*number),
        }
    }
}

/// The result of one measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The measure's name.
    pub measure: &'static str,
    /// What is right.
    pub bound: Quantity,
    /// What this program does.
    pub ours: Quantity,
    /// What the naive method does. If that is this program under naive settings: only if it is wrong.
    pub naive: Option<Quantity>,
    /// Whether this program is right.
    pub holds: bool,
}

/// A count that is right if at most `most` are wrong.
pub fn count(measure: &'static str, most: u64, ours: Count) -> Finding {
    let bound = Quantity::Count(Count { wrong: most, of: ours.of });
    let holds = ours.wrong <= most && ours.of > 0;
    Finding { measure, bound, ours: Quantity::Count(ours), naive: None, holds }
}

/// A number that is right up to `most`.
pub fn number(measure: &'static str, most: f64, ours: Result<f64, String>) -> Finding {
    let holds = ours.as_ref().is_ok_and(|&ours| ours <= most);
    let ours = ours.map_or_else(Quantity::Words, Quantity::Number);
    Finding { measure, bound: Quantity::Number(most), ours, naive: None, holds }
}

/// A whole number that is right if it is `exactly` this one.
pub fn whole(measure: &'static str, exactly: u64, ours: Result<u64, String>) -> Finding {
    let holds = ours == Ok(exactly);
    let ours = ours.map_or_else(Quantity::Words, Quantity::Whole);
    Finding { measure, bound: Quantity::Whole(exactly), ours, naive: None, holds }
}

/// A text that is right if it contains `part`.
pub fn words(measure: &'static str, part: &str, ours: String) -> Finding {
    let holds = ours.contains(part);
    Finding {
        measure,
        bound: Quantity::Words(part.to_owned()),
        ours: Quantity::Words(ours),
        naive: None,
        holds,
    }
}
