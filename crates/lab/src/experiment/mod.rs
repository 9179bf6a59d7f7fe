//! An experiment file: its fields, and the product of its lists.

pub mod accuracy; // Field `accuracy`.
pub mod fields; // The fields of an experiment file.
pub mod hemisphere; // Field `hemisphere`.
pub mod interfaces; // Fields `interfaces` and `virtual_walls`.
pub mod machine; // Field `machine`.
pub mod plot; // One of `plots`.
pub mod refine; // Field `refine`.
pub mod schema; // The JSON Schema of experiment files.
pub mod source_split; // Field `source_split`.
pub mod sweep; // Lists of values make a product of runs.
