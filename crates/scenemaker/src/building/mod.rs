//! "It represents five floors of a building without any furniture and with one thousand light
//! sources. This scene represents the Soda Hall Berkeley Computer Science building." (§5.1)
//!
//! The building resembles Soda Hall but does not have its plan. Rooms are along all four fronts.
//! Inside them are a ring of corridors and a central corridor (the spine); between these are rooms
//! without windows, two stair wells, and an atrium through all floors. Low floors have a few halls
//! and laboratories, high floors many small offices. A building of more than five floors repeats
//! this sequence, with the same shafts.

mod dimensions; // dimensions, and the bands and columns of the plan
mod layout; // the layout of a storey
mod lights; // one thousand lights
mod space; // the spaces of a storey and the openings between them
mod stairs; // stair wells

use crate::obj::Obj;
use crate::stream::stream;
use dimensions::{band, column, mirrored};
pub use layout::FLOORS;
use space::Plan;

/// Draws the scene with a number of floors.
pub fn draw(floors: u16, seed: u64) -> Obj {
    let mut obj = Obj::default();
    let mut rng = stream(seed, "walls");
    let floors = usize::from(floors);
    let plans: Vec<Plan> =
        (0..floors).map(|level| layout::lay_out(Plan::new(level, floors), &mut rng)).collect();
    for plan in &plans {
        plan.draw(&mut obj);
    }
    for x in [column::STAIRS, mirrored(column::STAIRS)] {
        stairs::draw(&mut obj, x, band::DEEP, floors);
    }
    lights::draw(&mut obj, &plans);
    obj
}
