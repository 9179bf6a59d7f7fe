//! An axis of a plot: linear, logarithmic, or names side by side.

/// Approximate number of ticks of a linear axis.
const TICKS: f64 = 7.0;
/// Largest number of values that can each have a tick.
const FEW: usize = 12;
/// Smallest distance between two such ticks, as a share of the axis.
const ROOM: f64 = 0.04;

/// An axis: maps values to positions, and has ticks.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    logarithmic: bool,
    ticks: Vec<f64>,
    names: Vec<String>,
}

impl Scale {
    /// A linear axis from 0, or from the least value if it is negative, to the greatest one, with room for a marker
    /// around both.
    pub fn linear(values: impl Iterator<Item = f64>) -> Scale {
        let (least, high) =
            values.fold((f64::MAX, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
        let low = least.min(0.0);
        let margin = 0.04 * (high - low);
        let low = if least < low + margin { low - margin } else { low };
        let high = if high > low { high + margin } else { low + 1.0 };
        let step = nice_step((high - low) / TICKS);
        let first = (low / step).ceil() as i64;
        let last = (high / step).floor() as i64;
        let ticks = (first..=last).map(|i| i as f64 * step).collect();
        Scale { low, high, logarithmic: false, ticks, names: Vec::new() }
    }

    /// A logarithmic axis around positive values.
    pub fn logarithmic(values: impl Iterator<Item = f64>) -> Scale {
        let (low, high) =
            values.fold((f64::MAX, 0.0), |(l, h): (f64, f64), v| (l.min(v), h.max(v)));
        let (low, high) = if low <= high { (low / 1.1, high * 1.1) } else { (1.0, 10.0) };
        let decades = (low.log10().floor() as i32)..=(high.log10().ceil() as i32);
        let digits: &[f64] = match (high / low).log10() {
            ..1.0 => &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
            ..3.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let ticks = decades
            .flat_map(|decade| digits.iter().map(move |digit| digit * 10_f64.powi(decade)))
            .filter(|tick| (low..=high).contains(tick))
            .collect();
        Scale { low, high, logarithmic: true, ticks, names: Vec::new() }
    }

    /// The axis with its ticks at the values themselves, if there are only a few. A tick too close to that
    /// of a greater value is left out.
    pub fn ticked_at(mut self, values: impl Iterator<Item = f64>) -> Scale {
        let mut values: Vec<f64> = values.collect();
        values.sort_by(|a, b| b.total_cmp(a));
        values.dedup();
        if values.is_empty() || values.len() > FEW {
            return self;
        }
        self.ticks.clear();
        for value in values {
            let room = |tick: &f64| (self.share(*tick) - self.share(value)).abs() >= ROOM;
            if self.ticks.last().is_none_or(room) {
                self.ticks.push(value);
            }
        }
        self.ticks.reverse();
        self
    }

    /// An axis of names, at 0, 1, 2, ...
    pub fn names(names: &[String]) -> Scale {
        let ticks = (0..names.len()).map(|i| i as f64).collect();
        let high = names.len() as f64 - 0.5;
        Scale { low: -0.5, high, logarithmic: false, ticks, names: names.to_vec() }
    }

    /// Where a value is on an axis with these ends.
    pub fn place(&self, value: f64, low: i32, high: i32) -> i32 {
        low + (self.share(value).clamp(-1.0, 2.0) * f64::from(high - low)).round() as i32
    }

    /// Whether it has names in place of numbers.
    pub fn is_of_names(&self) -> bool {
        !self.names.is_empty()
    }

    /// The values that have ticks, rising.
    pub fn ticks(&self) -> &[f64] {
        &self.ticks
    }

    /// The text of a tick.
    pub fn text(&self, tick: f64) -> String {
        // Ticks of names are their indices; a cast from f64 saturates.
        self.names.get(tick as usize).cloned().unwrap_or_else(|| tick_text(tick))
    }

    /// The lowest and the highest value.
    pub fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Position of a value on the axis: 0 at its low end, 1 at its high end.
    fn share(&self, value: f64) -> f64 {
        if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }
}

/// The smallest of 1, 2 or 5 times a power of ten that is not below `step`.
fn nice_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|digit| digit * power)
        .into_iter()
        .find(|nice| *nice >= step)
        .unwrap_or(step)
}

/// The text of a tick: with an exponent if the value is very large or very small.
fn tick_text(value: f64) -> String {
    let magnitude = value.abs();
    let short = format!("{value:.0e}");
    let large = magnitude >= 1e7 || magnitude >= 1e5 && short.parse() == Ok(value);
    if value != 0.0 && (magnitude < 1e-4 || large) {
        return short;
    }
    // Ticks have few digits; rounding hides that 3 × 0.1 is not quite 0.3.
    ((value * 1e6).round() / 1e6).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_inside_the_axis() {
        let axis = Scale::linear([1.0, 56.0].into_iter());
        assert_eq!(axis.ticks, [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]);
        assert_eq!(Scale::linear([50.0, 100.0].into_iter()).ends(), [0.0, 104.0]);
        let axis = Scale::linear([-100.0].into_iter());
        assert_eq!(axis.ends(), [-104.0, 4.0]);
        assert_eq!(Scale::linear([0.0, 100.0].into_iter()).ends(), [-4.0, 104.0]);
        let axis = Scale::logarithmic([1.0, 56.0].into_iter());
        assert_eq!(axis.ticks, [1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
        assert_eq!(tick_text(3.0 * 0.1), "0.3");
    }

    #[test]
    fn few_values_are_ticks_themselves_where_there_is_room() {
        let processors = || [1.0, 2.0, 4.0, 7.0, 8.0, 14.0, 28.0, 56.0].into_iter();
        let axis = Scale::linear(processors()).ticked_at(processors());
        assert_eq!(axis.ticks, [1.0, 4.0, 8.0, 14.0, 28.0, 56.0]);
        let axis = Scale::logarithmic(processors()).ticked_at(processors());
        assert_eq!(axis.ticks, [1.0, 2.0, 4.0, 8.0, 14.0, 28.0, 56.0]);
    }

    #[test]
    fn no_values_and_one_value_still_make_an_axis() {
        for axis in [
            Scale::linear([].into_iter()),
            Scale::linear([0.0].into_iter()),
            Scale::logarithmic([].into_iter()),
            Scale::logarithmic([3.0].into_iter()),
        ] {
            assert!(axis.low < axis.high, "{axis:?}");
            assert!(axis.place(axis.low, 10, 500) == 10 && axis.place(axis.high, 10, 500) == 500);
        }
    }
}
