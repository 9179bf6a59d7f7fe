//! The viewer of a report: runs as they were recorded, packed into a page that shows the light, the
//! machine and the time of any instant.
//!
//! A [`Film`] observes a run; [`Recorded`] packs films for a page whose [`program`] needs nothing but a
//! browser, and answers in words what one asks first. Knows nothing of experiment files and tables.

mod answers;
mod broadcast;
mod budget;
mod columns;
mod critical;
mod data;
mod film;
mod ledger;
mod live_page;
mod page;
mod reel;
mod run;
mod scene;
#[cfg(test)]
mod tests;

pub use broadcast::{Audience, Broadcast};
pub use film::Film;
pub use live_page::{LivePage, LiveRun};
pub use page::{MARKUP, Recorded, STYLE, program};
pub use reel::Reel;
