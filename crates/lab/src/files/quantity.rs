//! The quantities of experiment and scene files, and the ranges of their values.

use config::{Dimension, Measure, Quantity};

/// A length of more than 0 m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthKind;

impl Measure for LengthKind {
    const DIMENSION: Dimension = Dimension::Length;
    const EXAMPLE: &'static str = "0.30 m";
    const RANGE: &'static str = "more than 0";
    fn allows(value: f64) -> bool {
        value > 0.0
    }
}

/// A share from 0 to 100 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FractionKind;

impl Measure for FractionKind {
    const DIMENSION: Dimension = Dimension::Fraction;
    const RANGE: &'static str = "from 0 % to 100 %";
    fn allows(value: f64) -> bool {
        (0.0..=1.0).contains(&value)
    }
}

/// A span of virtual time of more than 0 s, up to a day: virtual time is counted in picoseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodKind;

impl Measure for PeriodKind {
    const DIMENSION: Dimension = Dimension::Time;
    const EXAMPLE: &'static str = "1 s";
    const RANGE: &'static str = "from 1 ps to 86400 s";
    fn allows(value: f64) -> bool {
        (1e-12..=86_400.0).contains(&value)
    }
}

/// An absorption of light a metre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AbsorptionKind;

impl Measure for AbsorptionKind {
    const DIMENSION: Dimension = Dimension::PerLength;
    const RANGE: &'static str = "from 0 /m to 1e9 /m";
    fn allows(value: f64) -> bool {
        (0.0..=1e9).contains(&value)
    }
}

/// A length, in metres.
pub type Length = Quantity<LengthKind>;
/// A share, from 0 to 1.
pub type Fraction = Quantity<FractionKind>;
/// A span of virtual time, in seconds.
pub type Period = Quantity<PeriodKind>;
/// An absorption of light, 1/m.
pub type Absorption = Quantity<AbsorptionKind>;
