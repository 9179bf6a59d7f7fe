//! Power laws fitted to measured points: straight lines on two logarithmic axes.

/// y = factor · x^exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    pub factor: f64,
    pub exponent: f64,
    /// Standard error of the exponent; none of two points, which a line always meets.
    pub error: Option<f64>,
}

impl PowerLaw {
    /// The law with the least squares of logarithms; `None` if positive points have fewer than two
    /// values of x.
    pub fn fit(points: &[(f64, f64)]) -> Option<PowerLaw> {
        let positive = points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
        let points: Vec<(f64, f64)> = positive.map(|(x, y)| (x.ln(), y.ln())).collect();
        let n = points.len() as f64;
        let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
        // Of no point, and of points over one x, there is no slope.
        if spread.is_nan() || spread <= 1e-12 {
            return None;
        }
        let exponent = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
        let height = y - exponent * x;
        let rest: f64 = points.iter().map(|p| (p.1 - height - exponent * p.0).powi(2)).sum();
        let error = (points.len() > 2).then(|| (rest / (n - 2.0) / spread).sqrt());
        Some(PowerLaw { factor: height.exp(), exponent, error })
    }

    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }

    pub fn words(&self) -> String {
        let error = self.error.map_or(String::new(), |error| format!(" ± {error:.2}"));
        // No "-0.00".
        let exponent = (self.exponent * 100.0).round() / 100.0 + 0.0;
        format!("exponent {exponent:.2}{error}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_is_found_again() {
        let points: Vec<(f64, f64)> =
            [1.0, 2.0, 10.0, 300.0].map(|x: f64| (x, 3.0 * x.powf(1.25))).to_vec();
        let law = PowerLaw::fit(&points).unwrap();
        assert!((law.factor - 3.0).abs() < 1e-9 && (law.exponent - 1.25).abs() < 1e-9, "{law:?}");
        assert!(law.error.unwrap() < 1e-9);
        assert!((law.at(7.0) - 3.0 * 7.0_f64.powf(1.25)).abs() < 1e-9);
        assert_eq!(law.words(), "exponent 1.25 ± 0.00");
    }

    /// The textbook's slope and its standard error, of e to the points (0,0), (1,1), (2,1).
    #[test]
    fn what_the_law_misses_is_its_error() {
        let points =
            [(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)].map(|(x, y): (f64, f64)| (x.exp(), y.exp()));
        let law = PowerLaw::fit(&points).unwrap();
        assert!((law.exponent - 0.5).abs() < 1e-12);
        assert!((law.error.unwrap() - (1.0_f64 / 12.0).sqrt()).abs() < 1e-12, "{law:?}");
    }

    #[test]
    fn two_points_make_a_law_and_fewer_none() {
        assert_eq!(PowerLaw::fit(&[(1.0, 2.0), (2.0, 2.0)]).unwrap().words(), "exponent 0.00");
        assert_eq!(PowerLaw::fit(&[]), None);
        assert_eq!(PowerLaw::fit(&[(1.0, 2.0)]), None);
        assert_eq!(PowerLaw::fit(&[(3.0, 2.0), (3.0, 4.0), (0.0, 1.0), (1.0, -1.0)]), None);
    }
}
