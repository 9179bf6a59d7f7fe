//! The back end that runs the programs on a simulated machine, in virtual time.

mod footprint; // what a program keeps in its node's memory
mod interpreter; // events of the machine as events of the algorithm
mod layout; // sizes of the records that kernels touch
mod prices; // time of the counted operations
mod process; // `Process` on a simulated node
mod simulation; // a whole run
mod start_up; // time of the initialisation (§4.2.1)
mod storage; // addresses of records, and the caches (§5.2)

pub use footprint::Thing;
pub use layout::Layout;
pub use simulation::{simulate, simulate_observed};
pub use start_up::{START_UP_STEPS, StartUpReport, start_up};
pub use storage::Storage;
