//! Repeats of one measurement: their mean and spread.

/// What repeats of a measurement tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeats {
    pub count: usize,
    pub mean: f64,
    /// Standard deviation of the population that the repeats are a sample of; none of one.
    pub deviation: Option<f64>,
    /// The 5 % and the 95 % quantile.
    pub low: f64,
    pub high: f64,
}

impl Repeats {
    /// None of no values.
    pub fn of(values: &[f64]) -> Option<Repeats> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (least, greatest) = (*sorted.first()?, *sorted.last()?);
        let count = sorted.len();
        let n = count as f64;
        // Equal values have their own mean, however it is rounded.
        let mean = (sorted.iter().sum::<f64>() / n).clamp(least, greatest);
        let squares: f64 = sorted.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (count > 1).then(|| (squares / (n - 1.0)).sqrt());
        let [low, high] = [0.05, 0.95].map(|share| quantile(&sorted, share));
        Some(Repeats { count, mean, deviation, low, high })
    }
}

/// The quantile of sorted values: linear between the two nearest, as by default in R and NumPy.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R: x <- c(4, 1, 3, 2, 10); mean(x), sd(x), quantile(x, c(.05, .95)).
    #[test]
    fn mean_and_spread_are_those_of_r() {
        let repeats = Repeats::of(&[4.0, 1.0, 3.0, 2.0, 10.0]).unwrap();
        assert_eq!((repeats.count, repeats.mean), (5, 4.0));
        assert!((repeats.deviation.unwrap() - 12.5_f64.sqrt()).abs() < 1e-12);
        assert!((repeats.low - 1.2).abs() < 1e-12 && (repeats.high - 8.8).abs() < 1e-12);
    }

    #[test]
    fn few_values_have_a_mean_too() {
        assert_eq!(Repeats::of(&[]), None);
        let one = Repeats { count: 1, mean: 7.0, deviation: None, low: 7.0, high: 7.0 };
        assert_eq!(Repeats::of(&[7.0]), Some(one));
        let three = Repeats::of(&[0.1; 3]).unwrap();
        assert_eq!((three.mean, three.deviation, three.low), (0.1, Some(0.0), 0.1));
    }
}
