//! Expressions over the rows of results: `max(time_s[scene=office] / time_s[scene=rooms])`.
//!
//! A column stands for its values in all rows that its filters leave; `+ - * /` work row by row; `min`,
//! `max`, `sum`, `abs` and `spread` (the geometric mean of the factors by which values differ from 1) do
//! what they say. Variables of a `for` line filter all columns. A filter `file=PATH` reads another file.

use crate::claims::Variables;
use crate::source::{Row, Sources};

/// The value of an expression in each row: its text where it is a plain cell.
pub struct Values {
    texts: Vec<String>,
    numbers: Result<Vec<f64>, String>,
}

impl Values {
    /// The text of the one cell.
    pub fn text(&self) -> Result<String, String> {
        one(&self.texts)
    }

    /// The one number.
    pub fn number(&self) -> Result<f64, String> {
        one(self.numbers.as_ref().map_err(String::clone)?)
    }

    fn of(numbers: Vec<f64>) -> Self {
        Self { texts: numbers.iter().map(f64::to_string).collect(), numbers: Ok(numbers) }
    }
}

fn one<T: PartialEq + Clone>(values: &[T]) -> Result<T, String> {
    let first = values.first().ok_or("no row")?;
    match values.iter().all(|value| value == first) {
        true => Ok(first.clone()),
        false => Err(format!("{} rows that differ", values.len())),
    }
}

/// The number at the start of a text such as `42 us`.
pub fn number(text: &str) -> Result<f64, String> {
    let first = text.split(' ').next().unwrap_or_default();
    first.parse().map_err(|_| format!("no number: '{text}'"))
}

/// Evaluates an expression over the rows of `file`.
pub fn evaluate(
    text: &str,
    file: &str,
    variables: &Variables,
    sources: &mut Sources,
) -> Result<Values, String> {
    let mut parser = Parser { rest: text.trim(), file, variables, sources };
    let values = parser.sum()?;
    match parser.rest {
        "" => Ok(values),
        rest => Err(format!("not understood: {rest}")),
    }
}

struct Parser<'a> {
    rest: &'a str,
    file: &'a str,
    variables: &'a Variables,
    sources: &'a mut Sources,
}

impl<'a> Parser<'a> {
    fn take(&mut self, mark: &str) -> bool {
        let after = self.rest.strip_prefix(mark);
        self.rest = after.unwrap_or(self.rest).trim_start();
        after.is_some()
    }

    fn until(&mut self, end: impl Fn(char) -> bool) -> &'a str {
        let at = self.rest.find(end).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(at);
        self.rest = rest;
        taken
    }

    fn sum(&mut self) -> Result<Values, String> {
        let mut left = self.product()?;
        loop {
            left = if self.take("+ ") {
                combine(&left, &self.product()?, |a, b| a + b)?
            } else if self.take("- ") {
                combine(&left, &self.product()?, |a, b| a - b)?
            } else {
                return Ok(left);
            }
        }
    }

    fn product(&mut self) -> Result<Values, String> {
        let mut left = self.factor()?;
        loop {
            left = if self.take("* ") {
                combine(&left, &self.factor()?, |a, b| a * b)?
            } else if self.take("/ ") {
                combine(&left, &self.factor()?, |a, b| a / b)?
            } else {
                return Ok(left);
            }
        }
    }

    fn factor(&mut self) -> Result<Values, String> {
        let name = self.until(|c| !(c.is_alphanumeric() || "_.".contains(c)));
        if self.take("(") {
            let inner = self.sum()?;
            return match self.take(")") {
                true => reduce(name, inner),
                false => Err("a ( without a )".to_owned()),
            };
        }
        if let Ok(number) = name.parse() {
            self.rest = self.rest.trim_start();
            return Ok(Values::of(vec![number]));
        }
        let mut filters = "";
        if self.take("[") {
            filters = self.until(|c| c == ']');
            self.take("]");
        }
        self.rest = self.rest.trim_start();
        self.column(name, filters)
    }

    fn column(&mut self, name: &str, filters: &str) -> Result<Values, String> {
        let mut filters: Vec<Filter> = filters
            .split(';')
            .filter(|f| !f.trim().is_empty())
            .map(Filter::new)
            .collect::<Result<_, _>>()?;
        let other =
            filters.iter().position(|filter| filter.column == "file").map(|at| filters.remove(at));
        let mut file = other.map_or(self.file, |filter| filter.value).to_owned();
        for (name, value) in self.variables {
            file = file.replace(&format!("<{name}>"), value);
        }
        let rows = self.sources.rows(&file)?;
        let columns = rows.first().ok_or("no rows")?;
        for (column, value) in self.variables {
            if columns.contains_key(column) && filters.iter().all(|filter| filter.column != column)
            {
                filters.push(Filter { column, relation: "=", value });
            }
        }
        let unknown = |column: &str| format!("{file} has no column {column}");
        if let Some(filter) = filters.iter().find(|filter| !columns.contains_key(filter.column)) {
            return Err(unknown(filter.column));
        }
        let left = rows.iter().filter(|row| filters.iter().all(|filter| filter.leaves(row)));
        let texts: Vec<String> = left
            .map(|row| row.get(name).cloned().ok_or_else(|| unknown(name)))
            .collect::<Result<_, _>>()?;
        if texts.is_empty() {
            return Err(format!("{file} has no row for {name}"));
        }
        let numbers = texts.iter().map(|text| number(text)).collect();
        Ok(Values { texts, numbers })
    }
}

struct Filter<'a> {
    column: &'a str,
    relation: &'a str,
    value: &'a str,
}

impl<'a> Filter<'a> {
    fn new(text: &'a str) -> Result<Self, String> {
        let relation =
            ["<=", ">=", "=", "<", ">"].into_iter().find(|relation| text.contains(relation));
        let relation = relation.ok_or_else(|| format!("no filter: {text}"))?;
        let (column, value) = text.split_once(relation).unwrap_or_default();
        Ok(Self { column: column.trim(), relation, value: value.trim() })
    }

    fn leaves(&self, row: &Row) -> bool {
        let cell = row.get(self.column).map_or("", String::as_str);
        let compared = || Some(number(cell).ok()?.total_cmp(&number(self.value).ok()?));
        match self.relation {
            "=" => cell == self.value,
            "<=" => compared().is_some_and(|order| order.is_le()),
            ">=" => compared().is_some_and(|order| order.is_ge()),
            "<" => compared().is_some_and(|order| order.is_lt()),
            _ => compared().is_some_and(|order| order.is_gt()),
        }
    }
}

/// Row by row; one number goes with all rows.
fn combine(
    left: &Values,
    right: &Values,
    apply: impl Fn(f64, f64) -> f64,
) -> Result<Values, String> {
    let (left, right) = (left.numbers.clone()?, right.numbers.clone()?);
    let rows = left.len().max(right.len());
    if [left.len(), right.len()].iter().any(|n| *n != 1 && *n != rows) {
        return Err(format!("{} rows with {}", left.len(), right.len()));
    }
    let at = |values: &[f64], row: usize| values[row.min(values.len() - 1)];
    Ok(Values::of((0..rows).map(|row| apply(at(&left, row), at(&right, row))).collect()))
}

fn reduce(name: &str, inner: Values) -> Result<Values, String> {
    let numbers = inner.numbers?;
    let rows = numbers.len() as f64;
    Ok(Values::of(match name {
        "" => numbers,
        "abs" => numbers.into_iter().map(f64::abs).collect(),
        "min" => vec![numbers.into_iter().fold(f64::INFINITY, f64::min)],
        "max" => vec![numbers.into_iter().fold(f64::NEG_INFINITY, f64::max)],
        "sum" => vec![numbers.into_iter().sum()],
        "spread" => vec![(numbers.into_iter().map(|x| x.ln().abs()).sum::<f64>() / rows).exp()],
        _ => return Err(format!("no function: {name}")),
    }))
}
