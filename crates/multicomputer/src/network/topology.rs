//! Topologies: places, the links between them, and the routes along the links.

use petgraph::graph::{DiGraph, EdgeIndex, NodeIndex};

/// A place of the network, where a node can be.
pub type Place = NodeIndex;

/// A link from one router to the next, one way.
pub type Link = EdgeIndex;

/// Coordinates of a place on a mesh or torus; elsewhere all places are in row 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Column, from 0.
    pub x: u32,
    /// Row, from 0.
    pub y: u32,
}

/// How places are connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Rows and columns.
    Mesh {
        /// Places in a row.
        width: u16,
        /// Rows.
        height: u16,
    },
    /// A mesh whose rows and columns of three places or more are closed to rings.
    Torus {
        /// Places in a row.
        width: u16,
        /// Rows.
        height: u16,
    },
    /// Every place is linked with one switch in both directions: a message takes two links.
    Crossbar {
        /// Places.
        places: u32,
    },
    /// All messages share one link, besides a link onto it and a link off it.
    Bus {
        /// Places.
        places: u32,
    },
}

/// A step of a route.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hop {
    /// The link taken.
    pub link: Link,
    /// Whether the message has passed the ring's start with this link or an earlier one of the same
    /// ring. If messages before and after that point use different virtual channels, they cannot
    /// wait for each other in a circle (Dally and Seitz 1987).
    pub wrapped: bool,
}

/// Places, one-way links, and dimension-order routing: along the row first, then along the column.
/// Places are numbered row by row.
#[derive(Clone, Debug)]
pub struct Topology {
    graph: DiGraph<(), ()>,
    shape: Shape,
    places: usize,
}

impl Topology {
    /// A topology of this shape.
    pub fn new(shape: Shape) -> Topology {
        let places = match shape {
            Shape::Mesh { width, height } | Shape::Torus { width, height } => {
                usize::from(width) * usize::from(height)
            }
            Shape::Crossbar { places } | Shape::Bus { places } => places as usize,
        };
        let mut topology = Topology { graph: DiGraph::new(), shape, places };
        (0..places).for_each(|_| _ = topology.graph.add_node(()));
        match shape {
            Shape::Mesh { .. } | Shape::Torus { .. } => topology.join_neighbours(),
            Shape::Crossbar { .. } => topology.join_hubs(1),
            Shape::Bus { .. } => topology.join_hubs(2),
        }
        topology
    }

    fn join_neighbours(&mut self) {
        let (width, height, rings) = self.grid();
        for place in self.graph.node_indices() {
            let Position { x, y } = self.position(place);
            let mut join = |x, y| {
                let other = NodeIndex::new((y * width + x) as usize);
                self.graph.add_edge(place, other, ());
                self.graph.add_edge(other, place, ());
            };
            match x {
                0 if rings && width > 2 => join(width - 1, y),
                0 => {}
                _ => join(x - 1, y),
            }
            match y {
                0 if rings && height > 2 => join(x, height - 1),
                0 => {}
                _ => join(x, y - 1),
            }
        }
    }

    /// Adds routers without nodes, each linked to the next. Every place is linked to the first and
    /// from the last.
    fn join_hubs(&mut self, count: usize) {
        let hubs: Vec<NodeIndex> = (0..count).map(|_| self.graph.add_node(())).collect();
        for pair in hubs.windows(2) {
            self.graph.add_edge(pair[0], pair[1], ());
        }
        for place in 0..self.places {
            self.graph.add_edge(NodeIndex::new(place), hubs[0], ());
            self.graph.add_edge(hubs[count - 1], NodeIndex::new(place), ());
        }
    }

    /// Width, height, and whether rows and columns are rings.
    fn grid(&self) -> (u32, u32, bool) {
        match self.shape {
            Shape::Mesh { width, height } => (width.into(), height.into(), false),
            Shape::Torus { width, height } => (width.into(), height.into(), true),
            Shape::Crossbar { places } | Shape::Bus { places } => (places, 1, false),
        }
    }

    /// How the places are connected.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// The routers, places first, and the one-way links between them.
    pub fn graph(&self) -> &DiGraph<(), ()> {
        &self.graph
    }

    /// Number of places.
    pub fn places(&self) -> usize {
        self.places
    }

    /// The place with a number, counted row by row; `None` beyond the last.
    pub fn place(&self, number: usize) -> Option<Place> {
        (number < self.places).then(|| NodeIndex::new(number))
    }

    /// A router's name in messages: the number of its place, or "hub".
    pub(crate) fn router(&self, router: NodeIndex) -> String {
        match router.index().checked_sub(self.places) {
            None => router.index().to_string(),
            Some(_) => "hub".to_owned(),
        }
    }

    /// Coordinates of a place.
    pub fn position(&self, place: Place) -> Position {
        let (width, ..) = self.grid();
        let number = place.index() as u32;
        Position { x: number % width, y: number / width }
    }

    /// Number of links of the route between two places.
    pub fn hops(&self, from: Place, to: Place) -> u32 {
        let (width, height, rings) = self.grid();
        match self.shape {
            _ if from == to => 0,
            Shape::Crossbar { .. } => 2,
            Shape::Bus { .. } => 3,
            Shape::Mesh { .. } | Shape::Torus { .. } => {
                let (a, b) = (self.position(from), self.position(to));
                let along = |a: u32, b: u32, size: u32| match a.abs_diff(b) {
                    way if rings && size > 2 => way.min(size - way),
                    way => way,
                };
                along(a.x, b.x, width) + along(a.y, b.y, height)
            }
        }
    }

    /// The links that a message takes from one place to another, in order.
    pub fn route(&self, from: Place, to: Place) -> Vec<Hop> {
        if let Shape::Crossbar { .. } | Shape::Bus { .. } = self.shape {
            let hubs = (self.places..self.graph.node_count()).map(NodeIndex::new);
            let stops: Vec<NodeIndex> =
                std::iter::once(from).chain(hubs).chain([to]).filter(|_| from != to).collect();
            let links = stops.windows(2).filter_map(|w| self.graph.find_edge(w[0], w[1]));
            return links.map(|link| Hop { link, wrapped: false }).collect();
        }
        let (width, height, rings) = self.grid();
        let (start, end) = (self.position(from), self.position(to));
        let columns = steps(start.x, end.x, width, rings).map(|(x, w)| (x, start.y, w));
        let rows = steps(start.y, end.y, height, rings).map(|(y, w)| (end.x, y, w));
        let mut here = from;
        let mut hops = Vec::with_capacity(self.hops(from, to) as usize);
        for (x, y, wrapped) in columns.chain(rows) {
            let next = NodeIndex::new((y * width + x) as usize);
            hops.extend(self.graph.find_edge(here, next).map(|link| Hop { link, wrapped }));
            here = next;
        }
        hops
    }
}

/// The coordinates after `from` on the shorter way to `to` (upwards if both directions of a ring are
/// equally long), each with whether the ring's start was passed.
fn steps(from: u32, to: u32, size: u32, ring: bool) -> impl Iterator<Item = (u32, bool)> {
    let ring = ring && size > 2;
    let up = if ring { (to + size - from) % size <= size / 2 } else { to > from };
    let mut state = (from, false);
    std::iter::from_fn(move || {
        let (here, wrapped) = state;
        (here != to).then(|| {
            state = match up {
                true if here + 1 == size => (0, true),
                true => (here + 1, wrapped),
                false if here == 0 => (size - 1, true),
                false => (here - 1, wrapped),
            };
            state
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Shape; 7] = [
        Shape::Mesh { width: 3, height: 5 },
        Shape::Mesh { width: 1, height: 1 },
        Shape::Torus { width: 4, height: 5 },
        Shape::Torus { width: 2, height: 3 },
        Shape::Torus { width: 1, height: 2 },
        Shape::Crossbar { places: 5 },
        Shape::Bus { places: 4 },
    ];

    #[test]
    fn a_mesh_has_its_places_and_links() {
        let mesh = Topology::new(Shape::Mesh { width: 4, height: 16 });
        assert_eq!(mesh.places(), 64);
        // Both ways: 3 in each of 16 rows, 15 in each of 4 columns.
        assert_eq!(mesh.graph().edge_count(), 2 * (3 * 16 + 15 * 4));
        assert_eq!(
            mesh.place(57).map(|place| mesh.position(place)),
            Some(Position { x: 1, y: 14 })
        );
        assert_eq!(mesh.place(64), None);
    }

    #[test]
    fn rings_of_a_torus_are_closed_from_three_places_on() {
        let links = |width, height| {
            Topology::new(Shape::Torus { width, height }).graph().edge_count() as u32
        };
        assert_eq!(links(4, 3), 2 * (4 * 3 + 4 * 3));
        assert_eq!(links(2, 3), 2 * (3 + 2 * 3));
        assert_eq!(links(1, 1), 0);
    }

    #[test]
    fn a_route_follows_the_row_and_then_the_column() {
        let ends = |shape, from, to| -> Vec<(u32, u32, bool)> {
            let topology = Topology::new(shape);
            let [from, to] = [from, to].map(NodeIndex::new);
            let hops = topology.route(from, to).into_iter();
            hops.map(|hop| {
                let (_, end) = topology.graph().edge_endpoints(hop.link).unwrap();
                let Position { x, y } = topology.position(end);
                (x, y, hop.wrapped)
            })
            .collect()
        };
        let mesh = Shape::Mesh { width: 4, height: 4 };
        let straight = [(2, 0, false), (1, 0, false), (1, 1, false), (1, 2, false)];
        assert_eq!(ends(mesh, 3, 9), straight);
        let torus = Shape::Torus { width: 5, height: 4 };
        let round = [(4, 3, false), (0, 3, true), (0, 0, true), (0, 1, true)];
        assert_eq!(ends(torus, 18, 5), round);
    }

    #[test]
    fn hops_are_the_links_of_the_route_and_the_shortest_way() {
        for topology in SHAPES.map(Topology::new) {
            for from in (0..topology.places()).map(NodeIndex::new) {
                let shortest = petgraph::algo::dijkstra(topology.graph(), from, None, |_| 1_u32);
                for to in (0..topology.places()).map(NodeIndex::new) {
                    let route = topology.route(from, to);
                    assert_eq!(route.len() as u32, topology.hops(from, to));
                    assert_eq!(shortest[&to], topology.hops(from, to));
                    // The route is connected.
                    let mut here = from;
                    for hop in route {
                        let (a, b) = topology.graph().edge_endpoints(hop.link).unwrap();
                        assert_eq!(a, here);
                        here = b;
                    }
                    assert_eq!(here, to);
                }
            }
        }
    }
}
