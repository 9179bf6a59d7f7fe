//! What an axis of a plot shows: a column of the results, or the product of several.

use crate::table::axis_title::{axis_title, names};
use crate::table::runs_csv::Table;

/// A column, or several with "*" between them, such as "patches*local_shots".
pub struct Measure<'a>(Vec<&'a str>);

impl<'a> Measure<'a> {
    pub fn of(text: &'a str) -> Measure<'a> {
        Measure(text.split('*').map(str::trim).collect())
    }

    pub fn columns(&self) -> &[&'a str] {
        &self.0
    }

    /// The product of a row's cells; `None` if one holds no number.
    pub fn value(&self, table: &Table, row: &[String]) -> Option<f64> {
        self.0.iter().map(|column| table.number(row, column)).product()
    }

    /// The unit of all cells of a single column that hold something, empty where there is none;
    /// `None` if they differ, or one is no number. A product has no unit.
    pub fn unit<'t>(&self, table: &'t Table) -> Option<&'t str> {
        let unit_of = |column: &str| {
            let filled = table.rows.iter().filter(|row| !table.cell(row, column).is_empty());
            let mut units = filled.map(|row| table.quantity(row, column).map(|(_, unit)| unit));
            let first = units.next()??;
            units.all(|unit| unit == Some(first)).then_some(first)
        };
        match self.0[..] {
            [column] => unit_of(column),
            _ => self.0.iter().all(|column| unit_of(column).is_some()).then_some(""),
        }
    }

    /// Its name for people, without units.
    pub fn words(&self) -> String {
        capital(&names(&self.0))
    }

    /// Its name with its unit, which may be that of its cells.
    pub fn title(&self, unit_of_cells: &str) -> String {
        capital(&axis_title(&self.0, unit_of_cells))
    }
}

/// Text with a capital first letter.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_multiplies_the_columns() {
        let own = |cells: [&str; 2]| cells.map(str::to_owned).to_vec();
        let rows = vec![own(["3", "0.5 m"]), own(["4", "none"])];
        let table = Table { columns: own(["shots", "size"]), rows };
        let product = Measure::of("shots * size");
        assert_eq!(product.value(&table, &table.rows[0]), Some(1.5));
        assert_eq!(product.value(&table, &table.rows[1]), None);
        assert_eq!(product.words(), "Shots × size");
        assert_eq!((product.unit(&table), Measure::of("shots").unit(&table)), (None, Some("")));
    }

    #[test]
    fn names_are_told_in_words() {
        let label = |name| Measure::of(name).title("");
        assert_eq!(label("time_s"), "Time (s)");
        assert_eq!(label("speed_up"), "Speed-up (ratio)");
        assert_eq!(label("messages"), "Messages");
        assert_eq!(label("message_bytes"), "Message bytes (B)");
        assert_eq!(label("time_s*speed_up"), "Time × speed-up (s × ratio)");
        assert_eq!(label("stop.patch_threshold"), "Patch threshold");
        assert_eq!(label("host.cpu_s"), "Host CPU (s)");
        assert_eq!(label("operations.ray"), "Rays counted");
        assert_eq!(label("patches*local_shots"), "Patches × local shots");
    }
}
