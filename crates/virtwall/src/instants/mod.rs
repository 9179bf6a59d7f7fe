//! The light of a simulated run at given instants, and at given thresholds, by running it again.

mod follower;
mod instants;
mod stops;

pub use follower::Instant;
pub use instants::visit_instants;
pub use stops::visit_stops;
