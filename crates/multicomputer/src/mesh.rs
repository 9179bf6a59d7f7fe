//! The mesh: places, the links between neighbours, and the routes along them.

use petgraph::graph::{DiGraph, EdgeIndex, NodeIndex};

/// A place on the mesh, where a node may stand.
pub type Place = NodeIndex;

/// A link from a place to a neighbour, one way.
pub type Link = EdgeIndex;

/// Coordinates of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Column, from 0.
    pub x: u32,
    /// Row, from 0.
    pub y: u32,
}

/// A two-dimensional mesh without wrap-around, with dimension-order routing: along the row first,
/// then along the column. Places are numbered row by row.
#[derive(Clone, Debug)]
pub struct Mesh {
    graph: DiGraph<Position, ()>,
    width: u32,
}

impl Mesh {
    /// A mesh of `width` × `height` places.
    pub fn new(width: u16, height: u16) -> Mesh {
        let (width, height) = (u32::from(width), u32::from(height));
        let mut mesh = Mesh { graph: DiGraph::new(), width };
        for y in 0..height {
            for x in 0..width {
                let place = mesh.graph.add_node(Position { x, y });
                if x > 0 {
                    mesh.join(place, mesh.at(Position { x: x - 1, y }));
                }
                if y > 0 {
                    mesh.join(place, mesh.at(Position { x, y: y - 1 }));
                }
            }
        }
        mesh
    }

    /// Links in both directions.
    fn join(&mut self, a: Place, b: Place) {
        self.graph.add_edge(a, b, ());
        self.graph.add_edge(b, a, ());
    }

    /// The places and the one-way links between neighbours.
    pub fn graph(&self) -> &DiGraph<Position, ()> {
        &self.graph
    }

    /// The place with a number, counted row by row; `None` beyond the last.
    pub fn place(&self, number: usize) -> Option<Place> {
        (number < self.graph.node_count()).then(|| NodeIndex::new(number))
    }

    /// Where a place of this mesh lies.
    pub fn position(&self, place: Place) -> Position {
        self.graph[place]
    }

    /// Links between two places of this mesh.
    pub fn hops(&self, from: Place, to: Place) -> u32 {
        let (a, b) = (self.position(from), self.position(to));
        a.x.abs_diff(b.x) + a.y.abs_diff(b.y)
    }

    /// The links that a message takes from one place to another, in order.
    pub fn route(&self, from: Place, to: Place) -> Vec<Link> {
        let (mut here, end) = (self.position(from), self.position(to));
        let mut links = Vec::new();
        while here != end {
            let next = if here.x != end.x {
                Position { x: towards(here.x, end.x), ..here }
            } else {
                Position { y: towards(here.y, end.y), ..here }
            };
            links.extend(self.graph.find_edge(self.at(here), self.at(next)));
            here = next;
        }
        links
    }

    fn at(&self, position: Position) -> Place {
        NodeIndex::new((position.y * self.width + position.x) as usize)
    }
}

fn towards(from: u32, to: u32) -> u32 {
    if to > from { from + 1 } else { from - 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_has_its_places_and_links() {
        let mesh = Mesh::new(4, 16);
        assert_eq!(mesh.graph().node_count(), 64);
        // Both ways: 3 in each of 16 rows, 15 in each of 4 columns.
        assert_eq!(mesh.graph().edge_count(), 2 * (3 * 16 + 15 * 4));
        assert_eq!(
            mesh.place(57).map(|place| mesh.position(place)),
            Some(Position { x: 1, y: 14 })
        );
        assert_eq!(mesh.place(64), None);
    }

    #[test]
    fn a_route_follows_the_row_and_then_the_column() {
        let mesh = Mesh::new(4, 4);
        let place = |x, y| mesh.at(Position { x, y });
        let ends: Vec<Position> = mesh
            .route(place(3, 0), place(1, 2))
            .into_iter()
            .filter_map(|link| mesh.graph().edge_endpoints(link))
            .map(|(_, to)| mesh.position(to))
            .collect();
        let expected = [(2, 0), (1, 0), (1, 1), (1, 2)].map(|(x, y)| Position { x, y });
        assert_eq!(ends, expected);
    }

    #[test]
    fn hops_are_the_links_of_the_route_and_the_shortest_way() {
        let mesh = Mesh::new(3, 5);
        for from in mesh.graph().node_indices() {
            let shortest = petgraph::algo::dijkstra(mesh.graph(), from, None, |_| 1_u32);
            for to in mesh.graph().node_indices() {
                let route = mesh.route(from, to);
                assert_eq!(route.len() as u32, mesh.hops(from, to));
                assert_eq!(shortest[&to], mesh.hops(from, to));
                // The route hangs together.
                let mut here = from;
                for link in route {
                    let (a, b) = mesh.graph().edge_endpoints(link).unwrap();
                    assert_eq!(a, here);
                    here = b;
                }
                assert_eq!(here, to);
            }
        }
    }
}
