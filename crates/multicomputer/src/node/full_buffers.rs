//! Deadlock by full buffers: senders that wait for room in each other's buffers.

use thiserror::Error;

use super::envelope::Rank;

/// A circle of processes, each of which waits for room in the buffers of the next one. None of them
/// will read what is in its own buffers.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("deadlock by full buffers: {}", self.waits())]
pub struct FullBuffers {
    /// Their ranks. The last one waits for the first.
    pub circle: Vec<Rank>,
}

impl FullBuffers {
    /// The circle that closes when `sender` begins to wait, if there is one. `waits_for` returns the
    /// rank in whose buffers a process waits for room.
    pub(crate) fn find(
        sender: Rank,
        waits_for: impl Fn(Rank) -> Option<Rank>,
    ) -> Option<FullBuffers> {
        let mut circle = vec![sender];
        let mut here = waits_for(sender)?;
        while here != sender {
            circle.push(here);
            here = waits_for(here)?;
        }
        Some(FullBuffers { circle })
    }

    /// The circle in words.
    fn waits(&self) -> String {
        if let [rank] = self.circle[..] {
            return format!("node {rank} waits for room in its own");
        }
        let ranks: Vec<String> = self.circle.iter().map(Rank::to_string).collect();
        let others = "waits for room in those of the next, and the last in those of the first";
        format!("each of the nodes {} {others}", ranks.join(", "))
    }
}
