//! The viewer's markup, style sheet and program, from the files in `assets/`.

use serde_json::Value;

/// The viewer's elements, without data.
pub const MARKUP: &str = include_str!("../../assets/viewer.html");
/// Its style sheet.
pub const STYLE: &str = include_str!("../../assets/viewer.css");
/// Its program: each file needs only those before it. A file that starts it follows.
const PROGRAM: [&str; 18] = [
    include_str!("../../assets/page.js"),
    include_str!("../../assets/data/columns.js"),
    include_str!("../../assets/data/scene.js"),
    include_str!("../../assets/data/run.js"),
    include_str!("../../assets/data/light.js"),
    include_str!("../../assets/state.js"),
    include_str!("../../assets/picture/matrices.js"),
    include_str!("../../assets/picture/camera.js"),
    include_str!("../../assets/picture/shaders.js"),
    include_str!("../../assets/picture/picture.js"),
    include_str!("../../assets/picture/steer.js"),
    include_str!("../../assets/panels/light.js"),
    include_str!("../../assets/panels/tree.js"),
    include_str!("../../assets/panels/machine.js"),
    include_str!("../../assets/panels/timeline.js"),
    include_str!("../../assets/panels/charts.js"),
    include_str!("../../assets/panels/nodes.js"),
    include_str!("../../assets/main.js"),
];

/// The script of a report.
pub fn program() -> String {
    script(&[include_str!("../../assets/start.js")])
}

pub(super) fn live_program() -> String {
    script(&[include_str!("../../assets/data/live-run.js"), include_str!("../../assets/live.js")])
}

fn script(start: &[&str]) -> String {
    let [program, start] = [PROGRAM.concat(), start.concat()];
    format!("<script>\n\"use strict\";\n{{\n{program}{start}}}\n</script>\n")
}

pub(super) fn index_element(index: &Value) -> String {
    // `<` could end the element.
    let index = index.to_string().replace('<', "\\u003c");
    format!("<script type=\"application/json\" id=\"viewer-index\">{index}</script>\n")
}
