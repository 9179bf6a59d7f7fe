//! One plot of an experiment file.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// One plot of the results.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plot {
    /// What runs along the horizontal axis: a column of runs.csv, a count of operations such as
    /// "operations.ray", a time of the host such as "host.cpu_s", or the product of several, such as
    /// "patches*local_shots".
    pub x: String,
    /// What runs along the vertical axis, said in the same way.
    pub y: String,
    /// Column whose values each make a line. Fields swept besides make lines of their own too where
    /// x is a swept field; where x is a figure of the runs, they run along the lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub series: Option<String>,
    /// Column whose values each make a panel. All panels have the same axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facet: Option<String>,
    /// Swept field whose values are repeats of one measurement, such as "seed": lines are means, in a band from the
    /// 5 % to the 95 % quantile. summary.csv then has mean, spread and count at each x. x is another swept field.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<String>,
    /// Reference lines, such as [{"y": 1, "label": "ideal"}].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<ReferenceLine>,
    /// Heading. Default: made from the columns' names.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Whether the horizontal axis is logarithmic.
    #[serde(default)]
    pub log_x: bool,
    /// Whether the vertical axis is logarithmic.
    #[serde(default)]
    pub log_y: bool,
    /// Whether to draw, in place of lines from point to point, the power law fitted to a line's
    /// points, and to name its exponent. Both axes are logarithmic then.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub power_law: bool,
    /// Whether to draw, in place of lines from point to point, lines through those points only that no
    /// other betters in x and y at once. Both axes are logarithmic then.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub pareto: bool,
    /// Runs to be marked: for some columns the values that they have, such as
    /// {"hemisphere.pixels": 30976}.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub mark: BTreeMap<String, Value>,
    /// What the marked runs are called. Default: "marked".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mark_name: Option<String>,
    /// Name of the SVG file, without folder or ending. Default: "<y>-by-<x>".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

impl Plot {
    /// Name of the SVG file, without folder or ending.
    pub fn stem(&self) -> String {
        let stem = || format!("{}-by-{}", self.y, self.x).replace(' ', "").replace('*', "-x-");
        self.file.clone().unwrap_or_else(stem)
    }

    /// Name of the SVG file.
    pub fn file_name(&self) -> String {
        self.stem() + ".svg"
    }

    /// Whether the horizontal and the vertical axis are logarithmic.
    pub fn logarithmic(&self) -> [bool; 2] {
        let both = self.power_law || self.pareto;
        [self.log_x || both, self.log_y || both]
    }
}

/// A straight line across a plot: at an x or at a y, one of the two.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReferenceLine {
    /// Where a vertical line is, in the unit of the horizontal axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// Where a horizontal line is, in the unit of the vertical axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<f64>,
    /// What it means, written beside it.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub label: String,
}
