//! Form factors.

pub mod clipping; // convex polygons cut by planes
pub mod closed_form; // formulas for special shapes
pub mod cubature; // adaptive integration over triangles
pub mod element; // from an element of area to a polygon
mod gauss; // Gauss–Legendre quadrature
pub mod object_rays; // between objects, by rays
pub mod objects; // between objects, by quadrature
pub mod pair; // between two polygons, with the shadows of others
pub mod sampling; // evenly spread points of surfaces

pub use cubature::{Estimate, Tolerance};
pub use element::element_to_polygon;
pub use object_rays::ObjectRays;
pub use objects::Objects;
pub use pair::{Pair, Surface};
