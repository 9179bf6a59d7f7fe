//! Form factors of patches, summed over the pixels that hit them.

use super::hemisphere::Hemisphere;
use crate::shoot::bundle::WIDTH;

/// One form factor for each place (a patch, the backs, the outside, a side): the sum of the weights
/// of the pixels whose rays end there.
pub(crate) enum FormFactors<'a> {
    /// Pixels of equal weight are counted. `sums[n]` is the sum of `n`, added one by one.
    Counted { pixels: Vec<u32>, sums: &'a [f64] },
    /// Pixels are added one by one. Unequal weights are rounded so that the order does not matter.
    Summed { sums: Vec<f64>, weights: &'a [f64] },
}

impl<'a> FormFactors<'a> {
    /// Counted if all pixels have the same weight.
    pub(crate) fn new(places: usize, hemisphere: &'a Hemisphere) -> FormFactors<'a> {
        match &hemisphere.sums {
            Some(sums) => FormFactors::Counted { pixels: vec![0; places], sums },
            None => FormFactors::one_by_one(places, hemisphere),
        }
    }

    /// Always added one by one: slower, simpler, the same to the bit.
    pub(crate) fn one_by_one(places: usize, hemisphere: &'a Hemisphere) -> FormFactors<'a> {
        FormFactors::Summed { sums: vec![0.0; places], weights: &hemisphere.weights }
    }

    /// Adds pixels of a bundle, one bit each, to a place.
    #[inline]
    pub(crate) fn add(&mut self, place: usize, bundle: usize, rays: u64) {
        match self {
            FormFactors::Counted { pixels, .. } => pixels[place] += rays.count_ones(),
            FormFactors::Summed { sums, weights } => {
                let mut rest = rays;
                while rest != 0 {
                    sums[place] += weights[bundle * WIDTH + rest.trailing_zeros() as usize];
                    rest &= rest - 1;
                }
            }
        }
    }

    /// The form factor of a place.
    pub(crate) fn of(&self, place: usize) -> f64 {
        match self {
            FormFactors::Counted { pixels, sums } => sums[pixels[place] as usize],
            FormFactors::Summed { sums, .. } => sums[place],
        }
    }
}
