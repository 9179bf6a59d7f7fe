//! The visibility mask of §3.2.

use crate::media::DepthBits;

/// One bit a pixel of the hemisphere; true means that the source is still visible through it. In a scene
/// with participating media one integer a pixel: how much they dim what is visible.
#[doc(alias = "Figure 2")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    words: Vec<u64>,
    pixels: u32,
    depths: Option<Box<Depths>>,
}

/// Steps of optical depth by pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Depths {
    bits: DepthBits,
    steps: Vec<u16>,
}

impl Mask {
    /// A mask with every pixel true: what a local source starts with (§3.3).
    pub fn all(pixels: u32) -> Mask {
        let mut words = vec![u64::MAX; words_for(pixels)];
        if let Some(last) = words.last_mut() {
            *last = last_word(pixels);
        }
        Mask::of(words, pixels)
    }

    /// A mask with every pixel false.
    pub fn none(pixels: u32) -> Mask {
        Mask::of(vec![0; words_for(pixels)], pixels)
    }

    /// A mask from its words, lowest pixel in the lowest bit of the first word; `None` when their
    /// number does not fit the pixels or a bit beyond the last pixel is set.
    pub fn from_words(words: Vec<u64>, pixels: u32) -> Option<Mask> {
        let fits = words.len() == words_for(pixels);
        let spilled = words.last().is_some_and(|last| last & !last_word(pixels) != 0);
        (fits && !spilled).then(|| Mask::of(words, pixels))
    }

    /// A mask from its integers; `None` when one is beyond those of so many bits.
    pub fn from_steps(steps: Vec<u16>, bits: DepthBits) -> Option<Mask> {
        if steps.iter().any(|&steps| steps > bits.hidden()) {
            return None;
        }
        let mut mask = Mask::none(steps.len() as u32);
        let visible = (0u32..).zip(&steps).filter(|&(_, &steps)| steps < bits.hidden());
        visible.for_each(|(pixel, _)| mask.set(pixel));
        mask.depths = Some(Box::new(Depths { bits, steps }));
        Some(mask)
    }

    fn of(words: Vec<u64>, pixels: u32) -> Mask {
        Mask { words, pixels, depths: None }
    }

    /// The same with an integer a pixel, for media; nothing has dimmed it so far.
    pub fn with_depths(self, bits: DepthBits) -> Mask {
        let steps = |pixel| if self.get(pixel) { 0 } else { bits.hidden() };
        let steps = (0..self.pixels).map(steps).collect();
        Mask { depths: Some(Box::new(Depths { bits, steps })), ..self }
    }

    /// The integers by pixel, if it has any, and their size.
    pub fn steps(&self) -> Option<(&[u16], DepthBits)> {
        self.depths.as_ref().map(|depths| (depths.steps.as_slice(), depths.bits))
    }

    /// The size of its integers, if it has any.
    pub fn depth_bits(&self) -> Option<DepthBits> {
        self.depths.as_ref().map(|depths| depths.bits)
    }

    /// Bits that a pixel takes.
    pub fn bits_a_pixel(&self) -> u32 {
        self.depth_bits().map_or(1, DepthBits::bits)
    }

    /// Optical depth that light through a true pixel has come through.
    pub fn depth(&self, pixel: u32) -> f64 {
        let depth = |depths: &Depths| f64::from(depths.steps[pixel as usize]) * depths.bits.step();
        self.depths.as_deref().map_or(0.0, depth)
    }

    /// What is left of the light through a true pixel.
    pub fn transmittance(&self, pixel: u32) -> f64 {
        let left = |depths: &Depths| depths.bits.transmittance(depths.steps[pixel as usize]);
        self.depths.as_deref().map_or(1.0, left)
    }

    /// Make a pixel true with the steps nearest to an optical depth, and tell what is then left of its
    /// light: nothing, and the pixel stays false, where there are no such steps.
    pub(crate) fn set_depth(&mut self, pixel: u32, depth: f64) -> f64 {
        if let Some(depths) = &mut self.depths {
            let Some(steps) = depths.bits.steps(depth) else { return 0.0 };
            depths.steps[pixel as usize] = steps;
        }
        self.set(pixel);
        self.transmittance(pixel)
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

    /// Make true what is true in the other mask as well; of two integers the lesser is left.
    pub fn merge(&mut self, other: &Mask) {
        if let (Some(mine), Some(theirs)) = (&mut self.depths, &other.depths) {
            for (mine, theirs) in mine.steps.iter_mut().zip(&theirs.steps) {
                *mine = (*mine).min(*theirs);
            }
        }
        for (mine, theirs) in self.words.iter_mut().zip(&other.words) {
            *mine |= theirs;
        }
    }
}

fn words_for(pixels: u32) -> usize {
    pixels.div_ceil(64) as usize
}

/// The last of so many pixels' words where all are true.
fn last_word(pixels: u32) -> u64 {
    u64::MAX >> (pixels.wrapping_neg() % 64)
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
    fn integers_are_rounded_and_run_out() {
        for (bits, most) in [(DepthBits::Eight, 7.9), (DepthBits::Sixteen, 15.99)] {
            let mut mask = Mask::none(3).with_depths(bits);
            for depth in [0.0, 0.3, 1.0, most] {
                let left = mask.set_depth(1, depth);
                let off = (left.ln() + depth).abs();
                assert!(off <= bits.step() * 0.500_001, "{bits:?} {depth}: {off}");
                assert_eq!((mask.transmittance(1), mask.count()), (left, 1));
            }
            assert_eq!((mask.set_depth(2, 17.0), mask.count()), (0.0, 1));
            let (steps, bits) = mask.steps().unwrap();
            assert_eq!(Mask::from_steps(steps.to_vec(), bits), Some(mask.clone()));
            let mut merged = Mask::none(3).with_depths(bits);
            merged.merge(&mask);
            assert_eq!(merged, mask);
        }
        assert_eq!(Mask::from_steps(vec![256], DepthBits::Eight), None);
    }

    #[test]
    fn refuses_words_that_do_not_fit() {
        assert_eq!(Mask::from_words(vec![0; 2], 130), None);
        assert_eq!(Mask::from_words(vec![0, 0, 4], 130), None);
        assert_eq!(Mask::from_words(vec![u64::MAX, u64::MAX, 3], 130), Some(Mask::all(130)));
    }
}
