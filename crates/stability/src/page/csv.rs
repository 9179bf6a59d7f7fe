//! The table of all findings as CSV.

use crate::finding::{Count, Quantity, ROUNDING};
use crate::suite::CaseResult;

/// The table: one line for each finding.
///
/// # Errors
/// Those of the CSV writer.
pub fn csv(results: &[CaseResult]) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["case", "measure", "naive", "ours", "right", "holds"])?;
    for result in results {
        for finding in &result.findings {
            let naive = finding.naive.as_ref().map_or(String::new(), raw);
            let (ours, right) = (raw(&finding.ours), raw(&finding.bound));
            let holds = finding.holds.to_string();
            writer.write_record([&result.name, finding.measure, &naive, &ours, &right, &holds])?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn raw(quantity: &Quantity) -> String {
    match quantity {
        Quantity::Count(Count { wrong, of }) => format!("{wrong} of {of}"),
        Quantity::Number(number) if *number > 0.0 && *number < ROUNDING => format!("<{ROUNDING:e}"),
        Quantity::Number(number) => format!("{number:.2e}"),
        Quantity::Whole(number) => number.to_string(),
        Quantity::Words(words) => words.clone(),
    }
}
