//! The results of an experiment as rows of text: what runs.csv holds, and all that is drawn from.

use crate::table::columns;

/// Rows under named columns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// One row a run, a cell a column.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a runs.csv.
    ///
    /// # Errors
    /// If a row has too few or too many cells, or is no text.
    pub fn from_csv(bytes: &[u8]) -> Result<Table, csv::Error> {
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let mut reader = csv::Reader::from_reader(bytes);
        let columns = cells(reader.headers()?);
        let rows = reader.records().map(|record| Ok(cells(&record?)));
        Ok(Table { columns, rows: rows.collect::<Result<_, csv::Error>>()? })
    }

    /// The table as CSV.
    ///
    /// # Errors
    /// None is known: it is written to memory.
    pub fn to_csv(&self) -> std::io::Result<Vec<u8>> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns)?;
        for row in &self.rows {
            writer.write_record(row)?;
        }
        writer.into_inner().map_err(|error| std::io::Error::other(error.to_string()))
    }

    /// The first cell with a number that is not finite: its row, from 1, and its column.
    pub fn not_finite(&self) -> Option<(usize, &str)> {
        let infinite = |cell: &String| {
            let number = cell.split(' ').next().unwrap_or_default();
            matches!(number, "NaN" | "inf" | "-inf")
        };
        let column = |row: &Vec<String>| row.iter().position(infinite);
        let (row, column) = (1..).zip(&self.rows).find_map(|(n, row)| Some((n, column(row)?)))?;
        Some((row, self.columns.get(column).map_or("a column", String::as_str)))
    }

    /// A cell, or one count of a cell of operations; empty if there is no such column.
    pub fn cell<'a>(&'a self, row: &'a [String], column: &str) -> &'a str {
        let [operations, one] = columns::OPERATIONS;
        if let Some(name) = column.strip_prefix(one) {
            let mut counts = self.cell(row, operations).split(' ');
            return counts
                .find_map(|count| count.strip_prefix(name)?.strip_prefix('='))
                .unwrap_or("");
        }
        let index = self.columns.iter().position(|name| name == column);
        index.and_then(|index| row.get(index)).map_or("", String::as_str)
    }

    /// A cell's number and its unit, which may be empty; `None` if it is no number.
    pub fn quantity<'a>(&'a self, row: &'a [String], column: &str) -> Option<(f64, &'a str)> {
        let text = self.cell(row, column).trim();
        let end = text.find(|c: char| !"+-.eE0123456789".contains(c)).unwrap_or(text.len());
        let number = text[..end].parse().ok().filter(|number: &f64| number.is_finite())?;
        Some((number, text[end..].trim()))
    }

    /// A cell as a number, its unit left out; `None` if it is none.
    pub fn number(&self, row: &[String], column: &str) -> Option<f64> {
        self.quantity(row, column).map(|(number, _)| number)
    }
}
