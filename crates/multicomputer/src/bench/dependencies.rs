//! Items that wait for others: which of them can begin.

/// For each item, by index, the number of items that it waits for, and the items that wait for it.
pub(super) struct Dependencies {
    waits_for: Vec<usize>,
    followers: Vec<Vec<usize>>,
}

impl Dependencies {
    /// Of items that each wait for the items of these indices, each named once.
    pub fn of<'a>(after: impl ExactSizeIterator<Item = &'a Vec<usize>>) -> Dependencies {
        let mut waits_for = Vec::with_capacity(after.len());
        let mut followers = vec![Vec::new(); after.len()];
        for (index, after) in after.enumerate() {
            waits_for.push(after.len());
            after.iter().for_each(|&earlier| followers[earlier].push(index));
        }
        Dependencies { waits_for, followers }
    }

    /// Whether an item waits for another.
    pub fn waits(&self, index: usize) -> bool {
        self.waits_for[index] > 0
    }

    /// An item has ended. Returns the items that waited for nothing else, by rising index.
    pub fn end(&mut self, index: usize) -> Vec<usize> {
        let mut followers = std::mem::take(&mut self.followers[index]);
        followers.retain(|&follower| {
            self.waits_for[follower] -= 1;
            self.waits_for[follower] == 0
        });
        followers
    }
}
