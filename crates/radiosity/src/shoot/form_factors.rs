//! Form factors while the pixels that make them up are counted.

use super::hemisphere::Hemisphere;
use crate::shoot::bundle::WIDTH;

/// A form factor for each of some places: the sum of the weights of the pixels that fell there.
pub(crate) enum FormFactors<'a> {
    /// Of pixels of one weight it is enough to count them; `sums` holds the sum of so many of them,
    /// added one by one.
    Counted { pixels: Vec<u32>, sums: &'a [f64] },
    /// Pixels added one by one; unequal weights are such that the order does not matter.
    Summed { sums: Vec<f64>, weights: &'a [f64] },
}

impl<'a> FormFactors<'a> {
    /// Counted where that will do.
    pub(crate) fn new(places: usize, hemisphere: &'a Hemisphere) -> FormFactors<'a> {
        match &hemisphere.sums {
            Some(sums) => FormFactors::Counted { pixels: vec![0; places], sums },
            None => FormFactors::one_by_one(places, hemisphere),
        }
    }

    /// Always one by one: slow, obvious, the same to the bit.
    pub(crate) fn one_by_one(places: usize, hemisphere: &'a Hemisphere) -> FormFactors<'a> {
        FormFactors::Summed { sums: vec![0.0; places], weights: &hemisphere.weights }
    }

    /// Pixels of a bundle, a bit each, fell at a place.
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
