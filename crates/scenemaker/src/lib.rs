//! Generates the three scenes of RR-3008, §5.1, and small test scenes, as OBJ and MTL text.
//!
//! The paper gives counts and one sentence for each scene, not its geometry. Each scene here fits
//! the sentence and, when meshed, the counts. Lengths are whole millimetres and are written in
//! metres. z is up, and the front of a polygon is the side from which its corners run
//! counter-clockwise. All scenes but the Cornell box are closed: no ray from inside escapes or hits
//! the back of a polygon.

mod building; // five floors with one thousand lights
mod furniture; // tables, chairs, bookcases
mod kind; // the scenes by name
mod make; // makes a scene by its kind
mod obj; // writes shapes as OBJ text
mod office; // one open room
mod palette; // materials
mod rooms; // 32 equal rooms
mod shapes; // rectangles, boxes, openings
mod small; // small scenes to compare methods on
mod stream; // named random streams

pub use kind::{SceneKind, UnknownScene};
pub use make::{FLOORS, make, make_building, make_rooms};
pub use obj::SceneText;
pub use rooms::MOST_TABLES;
