//! The committed schemas are those of the code. `UPDATE_SCHEMAS=1` writes them.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::Path;

use serde_json::Value;

fn shipped_is(name: &str, schema: &Value) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    let text = serde_json::to_string_pretty(schema).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMAS").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, &text).unwrap();
    }
    let shipped = fs::read_to_string(&path).unwrap_or_default();
    assert!(shipped == text, "{name} is out of date: run the test again with UPDATE_SCHEMAS=1");
}

#[test]
fn experiment_schema_is_shipped() {
    shipped_is("experiments/schemas/experiment.json", &lab::experiment_schema());
}

#[test]
fn scene_schema_is_shipped() {
    shipped_is("scenes/schemas/scene.json", &lab::scene_schema());
}

#[test]
fn schema_of_runs_csv_is_shipped() {
    shipped_is("experiments/schemas/runs.json", &lab::runs_schema());
}

#[test]
fn every_field_is_described_and_every_leaf_can_be_swept() {
    let schema = lab::experiment_schema();
    let fields = schema["properties"].as_object().unwrap();
    for (name, field) in fields {
        assert!(field["description"].is_string(), "{name}");
    }
    let unswept: Vec<_> = fields
        .iter()
        .filter(|(_, f)| f["anyOf"].is_null())
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(
        unswept,
        [
            "$schema",
            "title",
            "refine",
            "hemisphere",
            "virtual_walls",
            "source_split",
            "accuracy",
            "stop",
            "speed_up_over",
            "compare_with",
            "plots"
        ]
    );
    for group in unswept.into_iter().filter(|name| fields[*name]["properties"].is_object()) {
        for (name, field) in fields[group]["properties"].as_object().unwrap() {
            assert_eq!(field["anyOf"][1]["type"], "array", "{group}.{name}");
        }
    }
}
