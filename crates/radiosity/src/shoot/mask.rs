//! The visibility mask of an emitter (§3.2): one bit for each pixel of its hemisphere.

use crate::media::DepthBits;

/// One bit for each pixel of a hemisphere: true while nothing has blocked its ray. In a scene with
/// participating media, each pixel also has the optical depth so far, as an integer.
///
/// Paper: §3.2, Figure 2.
#[doc(alias = "Figure 2")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    words: Vec<u64>,
    pixels: u32,
    depths: Option<Box<Depths>>,
}

/// Optical depth of each pixel, in steps.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Depths {
    bits: DepthBits,
    steps: Vec<u16>,
}

impl Mask {
    /// A mask with all pixels true: the initial mask of a local source (§3.3).
    pub fn all(pixels: u32) -> Mask {
        let mut words = vec![u64::MAX; words_for(pixels)];
        if let Some(last) = words.last_mut() {
            *last = last_word(pixels);
        }
        Mask::of(words, pixels)
    }

    /// A mask with all pixels false.
    pub fn none(pixels: u32) -> Mask {
        Mask::of(vec![0; words_for(pixels)], pixels)
    }

    /// A mask from its words, with the first pixel in the lowest bit of the first word. `None` if
    /// the number of words does not fit the pixels or if a bit after the last pixel is set.
    pub fn from_words(words: Vec<u64>, pixels: u32) -> Option<Mask> {
        let fits = words.len() == words_for(pixels);
        let spilled = words.last().is_some_and(|last| last & !last_word(pixels) != 0);
        (fits && !spilled).then(|| Mask::of(words, pixels))
    }

    /// A mask from its optical depths in steps. `None` if one of them does not fit in `bits`.
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

    /// The same mask with optical depths, all zero.
    pub fn with_depths(self, bits: DepthBits) -> Mask {
        let steps = |pixel| if self.get(pixel) { 0 } else { bits.hidden() };
        let steps = (0..self.pixels).map(steps).collect();
        Mask { depths: Some(Box::new(Depths { bits, steps })), ..self }
    }

    /// Optical depth of each pixel in steps, and the size of these integers, if the mask has them.
    pub fn steps(&self) -> Option<(&[u16], DepthBits)> {
        self.depths.as_ref().map(|depths| (depths.steps.as_slice(), depths.bits))
    }

    /// The size of the optical depths, if the mask has them.
    pub fn depth_bits(&self) -> Option<DepthBits> {
        self.depths.as_ref().map(|depths| depths.bits)
    }

    /// Number of bits per pixel.
    pub fn bits_a_pixel(&self) -> u32 {
        self.depth_bits().map_or(1, DepthBits::bits)
    }

    /// Optical depth along the ray of a true pixel so far.
    pub fn depth(&self, pixel: u32) -> f64 {
        let depth = |depths: &Depths| f64::from(depths.steps[pixel as usize]) * depths.bits.step();
        self.depths.as_deref().map_or(0.0, depth)
    }

    /// Fraction of the light that is left along the ray of a true pixel.
    pub fn transmittance(&self, pixel: u32) -> f64 {
        let left = |depths: &Depths| depths.bits.transmittance(depths.steps[pixel as usize]);
        self.depths.as_deref().map_or(1.0, left)
    }

    /// Makes a pixel true with the nearest number of steps to an optical depth. Returns the
    /// fraction of light left: 0 beyond the last step, where the pixel stays false.
    pub(crate) fn set_depth(&mut self, pixel: u32, depth: f64) -> f64 {
        if let Some(depths) = &mut self.depths {
            let Some(steps) = depths.bits.steps(depth) else { return 0.0 };
            depths.steps[pixel as usize] = steps;
        }
        self.set(pixel);
        self.transmittance(pixel)
    }

    /// The words, first pixel first.
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

    /// Makes pixel `i` true.
    pub fn set(&mut self, i: u32) {
        self.words[i as usize / 64] |= 1 << (i % 64);
    }

    /// Makes the pixels of word `word` true whose bits are set.
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

    /// Makes all pixels true that are true in `other`, with the smaller optical depth.
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

/// The last word of a mask with all pixels true.
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
    fn optical_depths_are_rounded_and_limited() {
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
