//! Warnings about scenes that cannot be meant: without light, inside out, in another unit.

use radiosity::{ObjFile, Polygon, Scene};

use crate::open::first_light::{FirstLight, emits};

/// The share of the light of the lamps on backs from which on there is a warning.
const BACKS: f64 = 0.01;

/// The share of the light that leaves a room with a window or a gap, but not an outdoor scene.
const LEAVES: f64 = 0.01;

/// The share of the area that lamps have in a room; a sky has more.
const LAMPS: f64 = 0.25;

/// Longest way of light from a lamp, on average, metres: the largest halls are 160 m high.
const LONGEST: f64 = 200.0;

/// Names of the materials in use that older files would mean as lamps: by `Ka` above 1.
pub fn bright_ambients(file: &ObjFile) -> Vec<String> {
    let bright = file.used_materials().filter(|material| material.ambient.max_element() > 1.0);
    bright.map(|material| format!("\"{}\"", material.name())).collect()
}

/// Warnings if nothing emits light, if light is lost at once, or if the scene is too large to be in metres.
pub fn warnings(
    scene: &Scene,
    light: Option<&FirstLight>,
    bright_ambients: &[String],
) -> Vec<String> {
    let Some(light) = light else {
        let meant = match bright_ambients {
            _ if scene.polygons.iter().any(|polygon| emits(scene, polygon)) => return Vec::new(),
            [] => String::new(),
            names => format!(" (Ka is above 1 in {}, perhaps meant as lamps)", names.join(", ")),
        };
        let what_to_do = "give a material Ke in its MTL file, or in a scene file";
        return vec![format!("no polygon emits light, so that all is dark{meant}: {what_to_do}")];
    };
    let all = [outward(scene, light), away(light), unit(scene, light)];
    all.into_iter().flatten().collect()
}

/// That light falls on backs.
fn outward(scene: &Scene, light: &FirstLight) -> Option<String> {
    if light.backs < BACKS {
        return None;
    }
    let all = scene.polygons.len();
    let polygons = match scene.polygons.iter().filter(|polygon| faces_out(scene, polygon)).count() {
        0 => String::new(),
        count => format!(" ({count} of {all} polygons face out of the scene and have no patches)"),
    };
    Some(format!(
        "{} of the light of the lamps falls on backs, which absorb all light{polygons}: fronts are where \
         corners run counter-clockwise. To turn polygons over: virtwall scene flip; to make both sides \
         reflect: \"two_sided\": true in a scene file",
        percent(light.backs)
    ))
}

/// That all light leaves the scene.
fn away(light: &FirstLight) -> Option<String> {
    (light.leaves == 1.0).then(|| {
        "100 % of the light of the lamps leaves the scene, so that all else is dark: lamps shine from their \
         fronts, where corners run counter-clockwise. To turn them over: virtwall scene flip"
            .to_owned()
    })
}

/// That a closed room is larger than any room is.
fn unit(scene: &Scene, light: &FirstLight) -> Option<String> {
    let lamps = scene.polygons.iter().filter(|polygon| emits(scene, polygon)).map(|lamp| lamp.area);
    let is_room = light.leaves <= LEAVES && lamps.sum::<f64>() <= LAMPS * scene.area();
    if light.path <= LONGEST || !is_room {
        return None;
    }
    let [x, y, z] = scene.bounds.size().to_array().map(|metres| format!("{metres:.0}"));
    let unit = if light.path > 5.0 * LONGEST { "mm" } else { "cm" };
    Some(format!(
        "light goes {:.0} m from a lamp before it meets something, on average, in {x} x {y} x {z} m: lengths \
         are metres. If the file has others: \"unit\": \"{unit}\" in a scene file",
        light.path
    ))
}

/// A share that is not 0 or 1 as a percentage that is neither.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        all @ (0.0 | 100.0) => format!("{all} %"),
        part => format!("{:.1} %", part.clamp(0.1, 99.9)),
    }
}

/// Whether a polygon is in a side of the scene's bounds and faces outwards.
fn faces_out(scene: &Scene, polygon: &Polygon) -> bool {
    let (low, high) = (scene.bounds.min, scene.bounds.max);
    (0..3).any(|axis| {
        let normal = polygon.plane.normal[axis];
        let in_plane = |plane: f64| scene.corners(polygon).all(|corner| corner[axis] == plane);
        (normal == 1.0 && in_plane(high[axis])) || (normal == -1.0 && in_plane(low[axis]))
    })
}
