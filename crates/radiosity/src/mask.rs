//! The visibility mask of §3.2.

/// One bit a pixel of the hemisphere; true means that the source is still visible through it.
#[doc(alias = "Figure 2")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    words: Vec<u64>,
    pixels: u32,
}

impl Mask {
    /// A mask with every pixel true: what a local source starts with (§3.3).
    pub fn all(pixels: u32) -> Mask {
        let mut mask = Mask { words: vec![u64::MAX; words_for(pixels)], pixels };
        mask.clear_padding();
        mask
    }

    /// A mask with every pixel false.
    pub fn none(pixels: u32) -> Mask {
        Mask { words: vec![0; words_for(pixels)], pixels }
    }

    /// A mask from its words, lowest pixel in the lowest bit of the first word; `None` when their
    /// number does not fit the pixels or a bit beyond the last pixel is set.
    pub fn from_words(words: Vec<u64>, pixels: u32) -> Option<Mask> {
        let mask = Mask { words, pixels };
        if mask.words.len() != words_for(pixels) {
            return None;
        }
        let mut cleared = mask.clone();
        cleared.clear_padding();
        (cleared == mask).then_some(mask)
    }

    /// The words, lowest pixel first.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Number of pixels, true or false.
    pub fn pixels(&self) -> u32 {
        self.pixels
    }

    /// Whether pixel `i` is true.
    pub fn get(&self, i: u32) -> bool {
        self.words[i as usize / 64] >> (i % 64) & 1 == 1
    }

    /// Make pixel `i` true.
    pub fn set(&mut self, i: u32) {
        self.words[i as usize / 64] |= 1 << (i % 64);
    }

    /// Make the pixels true whose bits are set in word `word`.
    pub(crate) fn set_in_word(&mut self, word: usize, bits: u64) {
        self.words[word] |= bits;
    }

    /// Number of true pixels.
    pub fn count(&self) -> u32 {
        self.words.iter().map(|w| w.count_ones()).sum()
    }

    /// Whether no pixel is true.
    pub fn is_empty(&self) -> bool {
        self.words.iter().all(|&w| w == 0)
    }

    /// The true pixels in increasing order.
    pub fn ones(&self) -> impl Iterator<Item = u32> + '_ {
        self.words.iter().enumerate().flat_map(|(w, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                (rest != 0).then(|| {
                    let bit = rest.trailing_zeros();
                    rest &= rest - 1;
                    w as u32 * 64 + bit
                })
            })
        })
    }

    /// Make true what is true in the other mask as well.
    pub fn merge(&mut self, other: &Mask) {
        for (mine, theirs) in self.words.iter_mut().zip(&other.words) {
            *mine |= theirs;
        }
    }

    fn clear_padding(&mut self) {
        if let (Some(last), bits @ 1..) = (self.words.last_mut(), self.pixels % 64) {
            *last &= (1 << bits) - 1;
        }
    }
}

fn words_for(pixels: u32) -> usize {
    pixels.div_ceil(64) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_and_lists_the_same_pixels() {
        let mut mask = Mask::none(130);
        for i in [0, 63, 64, 129] {
            mask.set(i);
        }
        assert_eq!(mask.ones().collect::<Vec<_>>(), [0, 63, 64, 129]);
        assert_eq!(mask.count(), 4);
        assert_eq!(Mask::all(130).count(), 130);
    }

    #[test]
    fn refuses_words_that_do_not_fit() {
        assert_eq!(Mask::from_words(vec![0; 2], 130), None);
        assert_eq!(Mask::from_words(vec![0, 0, 4], 130), None);
        assert_eq!(Mask::from_words(vec![u64::MAX, u64::MAX, 3], 130), Some(Mask::all(130)));
    }
}
