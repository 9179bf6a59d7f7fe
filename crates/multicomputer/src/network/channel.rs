//! Channels: injection ports, links and ejection ports, which messages use in turns.

use super::topology::{Link, Place, Topology};

/// A channel that one message uses at a time, or one for each of its virtual channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Channel {
    /// From a node into its router: the node's port.
    Injection(Place),
    /// From router to router.
    Link(Link),
    /// From a router to its node.
    Ejection(Place),
}

/// The channels of a topology by number: injections, links, ejections.
#[derive(Clone, Debug)]
pub(crate) struct Channels {
    places: usize,
    links: usize,
}

impl Channels {
    pub(crate) fn of(topology: &Topology) -> Channels {
        Channels { places: topology.places(), links: topology.graph().edge_count() }
    }

    pub(crate) fn count(&self) -> usize {
        2 * self.places + self.links
    }

    pub(crate) fn number(&self, channel: Channel) -> usize {
        match channel {
            Channel::Injection(place) => place.index(),
            Channel::Link(link) => self.places + link.index(),
            Channel::Ejection(place) => self.places + self.links + place.index(),
        }
    }

    pub(crate) fn channel(&self, number: usize) -> Channel {
        match number.checked_sub(self.places) {
            None => Channel::Injection(Place::new(number)),
            Some(link) if link < self.links => Channel::Link(Link::new(link)),
            Some(rest) => Channel::Ejection(Place::new(rest - self.links)),
        }
    }
}

impl Channel {
    /// The channel in words: "link 3→4", "injection at 3".
    pub fn describe(self, topology: &Topology) -> String {
        match self {
            Channel::Injection(place) => format!("injection at {}", place.index()),
            Channel::Ejection(place) => format!("ejection at {}", place.index()),
            Channel::Link(link) => match topology.graph().edge_endpoints(link) {
                Some((from, to)) => {
                    format!("link {}→{}", topology.router(from), topology.router(to))
                }
                None => format!("link {}", link.index()),
            },
        }
    }
}
