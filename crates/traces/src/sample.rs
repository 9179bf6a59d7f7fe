//! Which messages of a run a trace shows.

/// One message in a number of messages. With a message its overhead and its change of a queue are left out;
/// all else is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample(u32);

impl Sample {
    /// Everything.
    pub const ALL: Sample = Sample(1);

    /// One message in `n`; 0 counts as 1.
    pub fn one_in(n: u32) -> Sample {
        Sample(n.max(1))
    }

    /// Whether the message or change of this number is shown.
    pub(crate) fn holds(self, number: usize) -> bool {
        number.is_multiple_of(self.0 as usize)
    }

    /// The title of a trace, with the sampling.
    pub(crate) fn caption(self, title: &str) -> String {
        match self.0 {
            1 => title.to_owned(),
            n => format!("{title}, one message in {n}"),
        }
    }
}
