//! The rule of sweeps: where one value is expected, a list sweeps it.

use std::collections::BTreeMap;

use config::{Dimension, Document, Fault, Place, Step, parse};
use serde_json::Value;

use crate::experiment::fields::UNSWEPT;
use crate::files::counts::{Pair, Triple};

/// Largest number of runs of an experiment; more is taken for a mistake.
const MOST_RUNS: usize = 100_000;

#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub place: Place,
    pub values: Vec<Value>,
}

/// One point of a sweep: an experiment without lists.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Which value of each axis this is.
    pub index: Vec<usize>,
    pub value: Value,
}

/// A sweep: its axes in the file's order, and the product of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The swept fields, the slowest first.
    pub axes: Vec<Axis>,
    /// All points, the last axis fastest.
    pub points: Vec<Point>,
}

impl Sweep {
    /// Finds every list of an experiment file and takes their product.
    ///
    /// # Errors
    /// If a list is empty, holds a value twice or another list, or if there are too many runs.
    pub fn of(document: &Document) -> Result<Sweep, Fault> {
        let mut axes = Vec::new();
        find_axes(document, &document.value, &Place::default(), &mut axes)?;
        let runs = axes.iter().try_fold(1_usize, |n, axis| n.checked_mul(axis.values.len()));
        let Some(runs) = runs.filter(|&runs| runs <= MOST_RUNS) else {
            let message = format!("the lists make more than {MOST_RUNS} runs; expected fewer");
            return Err(document.fault(&Place::default(), message));
        };
        let mut without_lists = document.value.clone();
        axes.iter().for_each(|axis| put(&mut without_lists, &axis.place, &Value::Null));
        let points = (0..runs).map(|run| point(&without_lists, &axes, run)).collect();
        Ok(Sweep { axes, points })
    }

    /// Translates a place in a point to its place in the file. In a swept field, that is inside the list's
    /// item.
    pub fn place_in_file(&self, point: &Point, place: Place) -> Place {
        let mut axes = self.axes.iter().zip(&point.index);
        match axes.find(|(axis, _)| axis.place.holds(&place)) {
            Some((axis, &item)) => {
                axis.place.item(item).join(&Place(place.0[axis.place.0.len()..].to_vec()))
            }
            None => place,
        }
    }
}

/// Collects the lists under `value`, in the file's order.
fn find_axes(
    document: &Document,
    value: &Value,
    place: &Place,
    axes: &mut Vec<Axis>,
) -> Result<(), Fault> {
    match value {
        Value::Object(fields) => {
            for (name, inner) in fields {
                if !place.0.is_empty() || !UNSWEPT.contains(&name.as_str()) {
                    find_axes(document, inner, &place.key(name), axes)?;
                }
            }
        }
        Value::Array(items) if !place.0.is_empty() => {
            check_list(document, items, place)?;
            axes.push(Axis { place: place.clone(), values: items.clone() });
        }
        _ => {}
    }
    Ok(())
}

fn check_list(document: &Document, items: &[Value], place: &Place) -> Result<(), Fault> {
    if items.is_empty() {
        return Err(document.fault(place, "an empty list; expected at least one value to sweep"));
    }
    if items.len() > MOST_RUNS {
        let message = format!("a list of {}; expected at most {MOST_RUNS} values", items.len());
        return Err(document.fault(place, message));
    }
    let mut known = BTreeMap::new();
    for (i, item) in items.iter().enumerate() {
        if has_list(item) {
            let message = format!("{item} inside a list; expected a single value to sweep");
            return Err(document.fault(&place.item(i), message));
        }
        if let Some(earlier) = known.insert(same_for_equals(item), item) {
            let first = if earlier == item { "" } else { &format!(", first as {earlier}") };
            let message =
                format!("{item} stands in the list twice{first}; expected each value once");
            return Err(document.fault(&place.item(i), message));
        }
    }
    Ok(())
}

/// A text that is the same for values that mean the same: "10 ms" and "0.01 s", 1 and 1.0.
fn same_for_equals(value: &Value) -> String {
    match value {
        Value::String(text) => {
            let quantity = Dimension::ALL.into_iter().find_map(|dimension| {
                // The last two digits may differ by rounding.
                Some(format!("{dimension:?} {:.14e}", parse(text, dimension).ok()?))
            });
            let counts = || {
                let triple = Triple::parse(text).map(|counts| counts.to_string());
                triple.or_else(|_| Pair::parse(text).map(|counts| counts.to_string())).ok()
            };
            quantity.or_else(counts).unwrap_or_else(|| value.to_string())
        }
        Value::Number(number) => match number.as_f64() {
            // Whole numbers beyond these are not all different as f64.
            Some(float) if number.is_f64() && float.abs() < 2_f64.powi(53) => {
                format!("{}", float + 0.0)
            }
            _ => number.to_string(),
        },
        Value::Object(fields) => {
            let inner = fields.iter().map(|(name, inner)| (name, same_for_equals(inner)));
            match fields.get("extends") {
                Some(machine) if fields.len() == 1 => same_for_equals(machine),
                _ => format!("{:?}", inner.collect::<BTreeMap<_, _>>()),
            }
        }
        other => other.to_string(),
    }
}

fn has_list(value: &Value) -> bool {
    match value {
        Value::Object(fields) => fields.values().any(has_list),
        value => value.is_array(),
    }
}

/// A value as text for tables. For an object: the name that it extends, then its other fields, each with
/// its path.
pub fn in_words(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        Value::Object(fields) => {
            let name = fields.get("extends").map(in_words);
            let mut words: Vec<String> = name.into_iter().collect();
            fields.iter().filter(|(key, _)| *key != "extends").for_each(|(key, field)| {
                let inner = if field.is_null() { "null".to_owned() } else { in_words(field) };
                let nested = if field.is_object() { '.' } else { ' ' };
                words.extend(inner.split(", ").map(|inner| format!("{key}{nested}{inner}")));
            });
            words.join(", ")
        }
        other => other.to_string(),
    }
}

/// Point number `run` of a file whose lists are left out. Its index has the digits of `run` in the mixed
/// radix of the axes, the last axis fastest.
fn point(file: &Value, axes: &[Axis], run: usize) -> Point {
    let mut value = file.clone();
    let mut index = vec![0; axes.len()];
    let mut rest = run;
    for (axis, chosen) in axes.iter().zip(&mut index).rev() {
        *chosen = rest % axis.values.len();
        rest /= axis.values.len();
        put(&mut value, &axis.place, &axis.values[*chosen]);
    }
    Point { index, value }
}

fn put(value: &mut Value, place: &Place, item: &Value) {
    let target = place.0.iter().fold(value, |value, step| match step {
        Step::Key(key) => &mut value[key.as_str()],
        Step::Item(index) => &mut value[*index],
    });
    *target = item.clone();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(text: &str) -> Result<Sweep, String> {
        let document = Document::parse("x.json".to_owned(), text.to_owned()).unwrap();
        Sweep::of(&document).map_err(|fault| fault.to_string())
    }

    #[test]
    fn runs_are_the_product_in_file_order_the_last_fastest() {
        let sweep =
            sweep(r#"{"a": [1, 2], "b": {"c": ["x", "y", "z"], "d": 4}, "plots": [1]}"#).unwrap();
        let axes: Vec<_> = sweep.axes.iter().map(|axis| axis.place.to_string()).collect();
        assert_eq!(axes, ["a", "b.c"]);
        let points: Vec<_> = sweep.points.iter().map(|point| point.value.to_string()).collect();
        assert_eq!(points.len(), 6);
        assert_eq!(points[0], r#"{"a":1,"b":{"c":"x","d":4},"plots":[1]}"#);
        assert_eq!(points[1], r#"{"a":1,"b":{"c":"y","d":4},"plots":[1]}"#);
        assert_eq!(points[5], r#"{"a":2,"b":{"c":"z","d":4},"plots":[1]}"#);
        assert_eq!(sweep.points[5].index, [1, 2]);
    }

    #[test]
    fn a_list_of_objects_sweeps_a_field() {
        let text = r#"{"a": ["x", {"extends": "x", "b": {"c": "1 s", "d": null}, "e": 2}]}"#;
        let sweep = sweep(text).unwrap();
        let cells: Vec<_> = sweep.axes[0].values.iter().map(in_words).collect();
        assert_eq!(cells, ["x", "x, b.c 1 s, b.d null, e 2"]);
        let place = sweep.place_in_file(&sweep.points[1], Place::of("a.b.c"));
        assert_eq!(place.to_string(), "a[1].b.c");
    }

    #[test]
    fn no_list_is_one_run() {
        let sweep = sweep(r#"{"a": 1}"#).unwrap();
        assert_eq!((sweep.axes.len(), sweep.points.len()), (0, 1));
    }

    #[test]
    fn lists_that_sweep_nothing_are_refused() {
        for (text, message) in [
            (r#"{"a": []}"#, "x.json:1: a: an empty list; expected at least one value to sweep"),
            (
                "{\n\"a\": {\"b\": [1,\n 2, 1]}}",
                "x.json:3: a.b[2]: 1 stands in the list twice; expected each value once",
            ),
            (
                r#"{"a": [{"b": [1]}]}"#,
                "x.json:1: a[0]: {\"b\":[1]} inside a list; expected a single value to sweep",
            ),
            (
                r#"{"a": [[1]]}"#,
                "x.json:1: a[0]: [1] inside a list; expected a single value to sweep",
            ),
        ] {
            assert_eq!(sweep(text).unwrap_err(), message);
        }
        let many = format!("[{}]", (0..400).map(|i| i.to_string()).collect::<Vec<_>>().join(","));
        let text = format!(r#"{{"a": {many}, "b": {many}}}"#);
        assert!(sweep(&text).unwrap_err().contains("more than 100000 runs"));
    }

    #[test]
    fn equal_values_in_other_spellings_are_refused() {
        for (list, message) in [
            (
                r#"["10 ms", "0.01 s"]"#,
                r#"a[1]: "0.01 s" stands in the list twice, first as "10 ms""#,
            ),
            (r#"["0.3 cm", "1 m", "3 mm"]"#, r#"a[2]: "3 mm" stands"#),
            (r#"["16 KB", "16000B"]"#, r#"first as "16 KB""#),
            (r#"["1x2x3", "1 x 2 x 03"]"#, r#"first as "1x2x3""#),
            ("[1, 1.0]", "1.0 stands in the list twice, first as 1;"),
            ("[-0.0, 0]", "first as -0.0"),
            (r#"["x", {"extends": "x"}]"#, r#"first as "x""#),
            (r#"[{"b": "1 s", "c": 1}, {"c": 1e0, "b": "1000 ms"}]"#, "stands in the list twice"),
        ] {
            let refused = sweep(&format!(r#"{{"a": {list}}}"#)).unwrap_err();
            assert!(refused.contains(message), "{refused}");
        }
        for list in [
            r#"["10 ms", "10 m", "10", 10, "10 %", "10 MHz"]"#,
            "[9007199254740993, 9007199254740992, 9007199254740992.5e3]",
            "[0.1, 0.10000000000000002]",
            r#"["a", "A", {"extends": "a", "b": 1}, {"extends": "a", "b": null}, null]"#,
        ] {
            assert!(sweep(&format!(r#"{{"a": {list}}}"#)).is_ok(), "{list}");
        }
    }

    /// Time that grows with the square of a list's length would be minutes here.
    #[test]
    fn long_lists_are_taken_or_refused_at_once() {
        let list = |count: u32| {
            let items: Vec<String> = (0..count).map(|i| format!("\"{i} mm\"")).collect();
            format!(r#"{{"a": [{}], "b": 1}}"#, items.join(","))
        };
        let all = sweep(&list(100_000)).unwrap();
        let last = &all.points[99_999];
        assert_eq!((all.points.len(), last.value["a"].as_str()), (100_000, Some("99999 mm")));
        let refused = sweep(&list(300_000)).unwrap_err();
        assert_eq!(refused, "x.json:1: a: a list of 300000; expected at most 100000 values");
    }
}
