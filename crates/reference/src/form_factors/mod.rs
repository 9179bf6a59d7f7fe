//! Form factors.
//!
//! - `closed_form`: formulas for special shapes
//! - `clipping`: convex polygons cut by planes
//! - `element`: from an element of area to a polygon
//! - `gauss`: Gauss–Legendre quadrature
//! - `cubature`: adaptive integration over triangles
//! - `pair`: between two polygons, with the shadows of others
//! - `objects`: between objects, by quadrature
//! - `sampling`: evenly spread points of surfaces
//! - `object_rays`: between objects, by rays

pub mod clipping;
pub mod closed_form;
pub mod cubature;
pub mod element;
mod gauss;
pub mod object_rays;
pub mod objects;
pub mod pair;
pub mod sampling;

pub use cubature::{Estimate, Tolerance};
pub use element::element_to_polygon;
pub use object_rays::ObjectRays;
pub use objects::Objects;
pub use pair::{Pair, Surface};
