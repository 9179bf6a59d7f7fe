//! Numbers of the emitters of a run: patches with the power that they shot, numbered as they occur.

use std::collections::BTreeMap;

use radiosity::Rgb;

use super::Columns;

#[derive(Default)]
pub(crate) struct Emitters {
    /// By environment and patch, and the power as bits, since floating-point numbers have no order.
    numbers: BTreeMap<((u32, u32), [u64; 3]), u64>,
    /// Those that no block has yet.
    fresh: Vec<((u32, u32), Rgb)>,
}

impl Emitters {
    pub fn number(&mut self, patch: (u32, u32), power: Rgb) -> u64 {
        let next = self.numbers.len() as u64;
        let number =
            *self.numbers.entry((patch, power.to_array().map(f64::to_bits))).or_insert(next);
        if number == next {
            self.fresh.push((patch, power));
        }
        number
    }

    /// Adds the columns of those that no block has yet.
    pub fn columns(&mut self, columns: &mut Columns) {
        let fresh = std::mem::take(&mut self.fresh);
        columns.ints(fresh.iter().map(|((environment, _), _)| u64::from(*environment)));
        columns.ints(fresh.iter().map(|((_, patch), _)| u64::from(*patch)));
        columns.floats(fresh.iter().flat_map(|(_, power)| power.to_array()));
    }
}
