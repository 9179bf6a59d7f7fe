//! Numbers as text.

/// A factor, to three digits.
pub(super) fn factor(factor: f64) -> String {
    if factor < 9.995 { format!("{factor:.2}") } else { format!("{factor:.1}") }
}

/// Seconds, to the microsecond.
pub(super) fn exact_seconds(seconds: f64) -> String {
    format!("{seconds:.6} s")
}

/// Seconds, to four digits.
pub(super) fn seconds(seconds: f64) -> String {
    let digits = match seconds {
        x if x >= 1000.0 => 0,
        x if x >= 100.0 => 1,
        x if x >= 10.0 => 2,
        x if x >= 1.0 => 3,
        _ => 4,
    };
    format!("{seconds:.digits$} s")
}

/// A share as a percentage. What is not all is never rounded to 100 %.
pub(super) fn percent(share: f64) -> String {
    match share {
        0.0 => "0 %".to_owned(),
        tiny if tiny < 0.0005 => "under 0.1 %".to_owned(),
        small if small < 0.0995 => format!("{:.1} %", 100.0 * small),
        most if (0.995..1.0).contains(&most) => format!("{:.1} %", (100.0 * most).min(99.9)),
        _ => format!("{:.0} %", 100.0 * share),
    }
}
