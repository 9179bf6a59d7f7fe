//! Generates the three scenes of RR-3008, §5.1, and small test scenes, as OBJ and MTL text.
//!
//! The paper gives counts and one sentence for each scene, not its geometry. Each scene here fits
//! the sentence and, when meshed, the counts. Lengths are whole millimetres and are written in
//! metres. z is up, and the front of a polygon is the side from which its corners run
//! counter-clockwise. All scenes but the Cornell box are closed: no ray from inside escapes or hits
//! the back of a polygon.
//!
//! - `make`: makes a scene by its kind
//! - `kind`: the scenes by name
//! - `scene_text`: the text of a scene's files
//! - `office`, `rooms`, `building`: the three scenes of the paper
//! - `small`: small scenes to compare methods on
//! - `furniture`: tables, chairs, bookcases
//! - `palette`: materials
//! - `shapes`: rectangles, boxes, openings
//! - `obj`: writes shapes as OBJ text
//! - `stream`: named random streams

mod building;
mod furniture;
mod kind;
mod make;
mod obj;
mod office;
mod palette;
mod rooms;
mod scene_text;
mod shapes;
mod small;
mod stream;

pub use kind::{SceneKind, UnknownScene};
pub use make::{FLOORS, make, make_building, make_rooms};
pub use rooms::MOST_TABLES;
pub use scene_text::SceneText;
