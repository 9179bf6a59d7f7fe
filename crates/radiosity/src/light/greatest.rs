//! A tournament tree: the greatest of many values of which a few change at a time.

/// A tournament tree: above the values is the greater of each pair, of each pair of pairs, and so
/// on. Changing a value and finding the greatest one take logarithmic time.
#[derive(Clone, Debug)]
pub struct Greatest {
    /// The greatest value at 1, the values from `leaves` on. Below `i` are 2 i and 2 i + 1.
    tree: Vec<f64>,
    leaves: usize,
}

impl Greatest {
    /// A tree over values, none of them negative.
    pub fn new(values: impl ExactSizeIterator<Item = f64>) -> Greatest {
        let leaves = values.len().next_power_of_two();
        let mut tree = vec![0.0; 2 * leaves];
        for (leaf, value) in tree[leaves..].iter_mut().zip(values) {
            *leaf = value;
        }
        for i in (1..leaves).rev() {
            tree[i] = f64::max(tree[2 * i], tree[2 * i + 1]);
        }
        Greatest { tree, leaves }
    }

    /// Changes a value.
    pub fn set(&mut self, place: u32, value: f64) {
        let mut i = self.leaves + place as usize;
        self.tree[i] = value;
        while i > 1 {
            i /= 2;
            let greater = f64::max(self.tree[2 * i], self.tree[2 * i + 1]);
            if self.tree[i] == greater {
                break;
            }
            self.tree[i] = greater;
        }
    }

    /// The greatest value and its index, the first of equal ones. `None` if no value is positive.
    pub fn best(&self) -> Option<(f64, u32)> {
        let greatest = self.tree[1];
        let mut i = 1;
        while i < self.leaves {
            i = 2 * i + usize::from(self.tree[2 * i] < greatest);
        }
        (greatest > 0.0).then(|| (greatest, (i - self.leaves) as u32))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The same by a search through all values.
    fn searched(values: &[f64]) -> Option<(f64, u32)> {
        let positive = values.iter().copied().zip(0..).filter(|&(value, _)| value > 0.0);
        positive.reduce(|best, other| if other.0 > best.0 { other } else { best })
    }

    proptest! {
        #[test]
        fn the_tree_finds_the_same_as_a_search(
            start in proptest::collection::vec(0u8..4, 0..40),
            changes in proptest::collection::vec((0usize..40, 0u8..4), 0..60),
        ) {
            let mut values: Vec<f64> = start.into_iter().map(f64::from).collect();
            let mut greatest = Greatest::new(values.iter().copied());
            prop_assert_eq!(greatest.best(), searched(&values));
            for (place, value) in changes {
                if place < values.len() {
                    values[place] = f64::from(value);
                    greatest.set(place as u32, f64::from(value));
                    prop_assert_eq!(greatest.best(), searched(&values));
                }
            }
        }
    }
}
