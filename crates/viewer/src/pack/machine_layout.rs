//! Where the nodes of a run are on its machine.

use multicomputer::{Machine, Shape};
use serde_json::{Value, json};

/// Width and height of the machine, whether it is a mesh, and the place of each rank, the service node
/// last. Machines without rows are laid out as a square.
pub(crate) fn machine_layout(machine: &Machine, processors: usize) -> Value {
    let topology = machine.topology();
    let places = topology.places().max(1);
    let (width, height, mesh) = match topology.shape() {
        Shape::Mesh { width, height } => (usize::from(width), usize::from(height), true),
        Shape::Torus { width, height } => (usize::from(width), usize::from(height), false),
        Shape::Crossbar { .. } | Shape::Bus { .. } => {
            let width = places.isqrt().max(1);
            (width, places.div_ceil(width), false)
        }
    };
    let ranks = (0..processors).chain([machine.compute_nodes()]);
    json!({ "width": width, "height": height, "mesh": mesh, "places": ranks.collect::<Vec<_>>() })
}
