//! Field `machine`: a machine by its name, or one that extends it.

use std::borrow::Cow;
use std::fmt;

use config::{Place, Step};
use multicomputer::machine_changes_schema;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The machine of an experiment that names none.
const DEFAULT: &str = "paragon-xps";

/// The field by which an experiment chooses the model of the network.
pub const NETWORK_MODEL: &str = "machine.network.model";

/// A machine by its name, or an object: the name under "extends", and fields of a machine file that
/// take the place of that machine's.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct MachineChoice(Value);

impl MachineChoice {
    /// The machine that is named, or extended.
    pub fn name(&self) -> &str {
        let name = self.0.as_str().or_else(|| self.0.get("extends")?.as_str());
        name.unwrap_or(DEFAULT)
    }

    /// What the experiment changes of it, if anything.
    pub fn changes(&self) -> Option<Value> {
        let mut changes = self.0.clone();
        changes.as_object_mut()?.shift_remove("extends");
        Some(changes)
    }

    pub fn chooses_network_model(&self) -> bool {
        self.0.pointer("/network/model").is_some()
    }

    /// Where in the experiment a place of the machine is: a bare value stands for the object of value,
    /// provenance and source that a machine file has there.
    pub fn place(&self, of_machine: &Place) -> Place {
        let mut value = &self.0;
        let steps =
            of_machine.0.iter().take_while(|step| match (value.get(step_key(step)), value) {
                (Some(inner), _) => {
                    value = inner;
                    true
                }
                (None, bare) => bare.is_object(),
            });
        Place::of("machine").join(&Place(steps.cloned().collect()))
    }
}

fn step_key(step: &Step) -> &str {
    match step {
        Step::Key(key) => key,
        Step::Item(_) => "",
    }
}

/// Makes room for arguments such as `--set machine.network.model=flit` in an experiment that names its
/// machine, or several: each name moves to an "extends". If the argument is a list, all names do together.
pub fn open_up(experiment: &mut Value, by_list: bool) {
    match experiment.get_mut("machine") {
        Some(Value::Array(machines)) if !by_list => machines.iter_mut().for_each(extend),
        Some(Value::Array(machines)) if !machines.iter().all(Value::is_string) => {}
        Some(machine) => extend(machine),
        None => {}
    }
}

fn extend(machine: &mut Value) {
    if !machine.is_object() {
        *machine = json!({ "extends": machine.take() });
    }
}

impl Default for MachineChoice {
    fn default() -> MachineChoice {
        MachineChoice(DEFAULT.into())
    }
}

impl fmt::Display for MachineChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl<'de> Deserialize<'de> for MachineChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<MachineChoice, D::Error> {
        let value = Value::deserialize(deserializer)?;
        let name = if value.is_object() { value.get("extends") } else { Some(&value) };
        match name.filter(|name| !name.is_string()) {
            None => Ok(MachineChoice(value)),
            Some(other) => Err(D::Error::custom(format!(
                "found {other}; expected the name of a machine, or an object that \"extends\" one"
            ))),
        }
    }
}

impl JsonSchema for MachineChoice {
    fn schema_name() -> Cow<'static, str> {
        "MachineChoice".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "string" }, machine_changes_schema()] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(value: &Value) -> MachineChoice {
        serde_json::from_value(value.clone()).unwrap()
    }

    #[test]
    fn places_end_where_a_bare_value_is() {
        let machine = choice(&json!({ "processor": { "clock": "5", "scale": { "value": 0 } } }));
        assert_eq!((machine.name(), machine.chooses_network_model()), (DEFAULT, false));
        for (of_machine, place) in [
            ("processor.clock.value", "machine.processor.clock"),
            ("processor.scale.value", "machine.processor.scale.value"),
            ("mesh.width.value", "machine.mesh.width.value"),
            ("", "machine"),
        ] {
            assert_eq!(machine.place(&Place::of(of_machine)).to_string(), place);
        }
        assert_eq!(choice(&json!("x")).place(&Place::of("mesh")).to_string(), "machine");
    }

    #[test]
    fn names_make_room_for_changes() {
        let items = json!({ "machine": [{ "extends": "a" }, { "extends": "b" }] });
        for (before, by_list, after) in [
            (json!({ "machine": "a" }), false, json!({ "machine": { "extends": "a" } })),
            (json!({ "machine": ["a", "b"] }), false, items),
            (
                json!({ "machine": ["a", "b"] }),
                true,
                json!({ "machine": { "extends": ["a", "b"] } }),
            ),
            (
                json!({ "machine": ["a", {}] }),
                false,
                json!({ "machine": [{ "extends": "a" }, {}] }),
            ),
            (json!({ "machine": ["a", {}] }), true, json!({ "machine": ["a", {}] })),
            (json!({}), false, json!({})),
        ] {
            let mut experiment = before;
            open_up(&mut experiment, by_list);
            assert_eq!(experiment, after);
        }
    }
}
