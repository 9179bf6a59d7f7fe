//! Traces from users' files: valid and invalid ones.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::PathBuf;

use multicomputer::{Trace, trace_schema};
use serde_json::{Value, json};

fn message(file: &Value) -> String {
    Trace::from_json(&file.to_string(), "t.json", 4).unwrap_err().to_string()
}

fn good(id: &str) -> Value {
    json!({ "id": id, "at": "0 us", "from": 0, "to": 3, "bytes": 4096 })
}

/// Two messages, the second with one field changed.
fn with(field: &str, value: Value) -> Value {
    let mut second = good("b");
    second[field] = value;
    json!([good("a"), second])
}

#[test]
fn numbers_are_names_too() {
    let mut second = good("x");
    (second["id"], second["after"]) = (json!(7), json!(["a", "a"]));
    let mut third = good("c");
    third["after"] = json!([7, "a"]);
    let text = json!([good("a"), second, third]).to_string();
    let trace = Trace::from_json(&text, "t.json", 4).unwrap();
    assert_eq!(trace.messages[1].name, "7");
    assert_eq!(trace.messages[1].after, [0]);
    assert_eq!(trace.messages[2].after, [0, 1]);
}

#[test]
fn faults_name_message_field_value_and_what_was_expected() {
    let place = |text: &str| {
        // Line and column come first where serde knows them.
        let (file, rest) = text.split_once(": ").unwrap();
        assert!(file.starts_with("t.json"), "{text}");
        rest.to_owned()
    };
    for (file, expected) in [
        (with("to", json!(4)), "[1].to: found 4; expected a node, 0 to 3"),
        (with("from", json!(99)), "[1].from: found 99; expected a node, 0 to 3"),
        (with("from", json!(-1)), "[1].from: found -1; expected a whole number, 0 or more"),
        (
            with("bytes", json!(2_000_000_000)),
            "[1].bytes: found 2000000000; expected at most 1000000000",
        ),
        (
            with("at", json!("5")),
            r#"[1].at: found "5" without a unit; expected a time such as "40 ns""#,
        ),
        (with("at", json!("1e6 s")), "[1].at: found 1000000 s; expected at most 86400 s"),
        (with("id", json!("a")), r#"[1].id: found "a", the id of [0]; expected one of its own"#),
        (
            with("id", json!("a,b")),
            r#"[1].id: found "a,b"; expected a name without spaces, commas, quotes"#,
        ),
        (with("id", json!(1.5)), "[1].id: a name or a whole number"),
        (with("after", json!(["z"])), r#"[1].after[0]: found "z"; expected the id of a message"#),
        (
            with("after", json!(["b"])),
            r#"[1].after: found a circle, "b" after "b"; expected messages that can be sent"#,
        ),
        (
            with("size", json!(1)),
            "[1].size: unknown field \"size\" (there are: id, at, from, to, bytes, after)",
        ),
        (json!({}), "found an object; expected a list"),
    ] {
        assert_eq!(place(&message(&file)), expected);
    }
}

#[test]
fn circles_are_named() {
    let mut items = ["a", "b", "c", "d"].map(good);
    for (item, after) in [(0, "c"), (1, "a"), (2, "b"), (3, "a")] {
        items[item]["after"] = json!([after]);
    }
    assert_eq!(
        message(&json!(items)),
        r#"t.json:1: [0].after: found a circle, "a" after "c" after "b" after "a"; expected messages that can be sent"#
    );
}

/// `count` messages between two nodes, each after the one that `after` gives it.
fn chain(count: usize, after: impl Fn(usize) -> Option<usize>) -> String {
    let items = (0..count).map(|i| {
        let after = Vec::from_iter(after(i));
        let (from, to) = (i % 2, 1 - i % 2);
        json!({ "id": i, "at": "0 us", "from": from, "to": to, "bytes": 64, "after": after })
    });
    Value::from_iter(items).to_string()
}

#[test]
fn chains_and_circles_may_be_long() {
    const COUNT: usize = 100_000;
    for text in [
        chain(COUNT, |i| i.checked_sub(1)),
        chain(COUNT, |i| Some(i + 1).filter(|&next| next < COUNT)),
    ] {
        assert_eq!(Trace::from_json(&text, "t.json", 4).unwrap().messages.len(), COUNT);
    }
    // A circle, and a chain of messages that wait for it.
    for (count, length) in [(COUNT, COUNT), (100, 99), (100, 21), (100, 20)] {
        let text = chain(count, |i| i.checked_sub(1).or(Some(length - 1)));
        let fault = Trace::from_json(&text, "t.json", 4).unwrap_err().to_string();
        let begin = format!("found a circle, \"0\" after \"{}\" after ", length - 1);
        assert!(fault.contains(&begin) && fault.len() < 1_000, "{fault:.100}");
        let end = format!(" and so on, {} more; expected messages that can be sent", length - 19);
        assert!(fault.ends_with(&end), "{fault}");
    }
}

#[test]
fn the_committed_schema_is_up_to_date() {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/schemas"));
    let path = path.join("trace.json");
    let mut text = serde_json::to_string_pretty(&trace_schema()).unwrap();
    text.push('\n');
    if std::env::var_os("UPDATE_SCHEMAS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    let shipped = fs::read_to_string(&path).unwrap_or_default();
    assert!(shipped == text, "machines/schemas/trace.json is stale: UPDATE_SCHEMAS=1 cargo test");
}
