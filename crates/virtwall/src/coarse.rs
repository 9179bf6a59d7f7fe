//! Masks coarser than the hemisphere: shorter messages, and light that strays by a bit's width.
//!
//! What travels is a bit for some neighbouring pixels. The receiver casts those pixels of its true bits
//! whose rays cross the interface that the source comes through, so that each stays on its way and
//! gets somewhere; their power is scaled to what has left the sender, so that no energy is lost.

use radiosity::glam::DVec3;
use radiosity::{Bounds, Mask, Side};

use crate::message::Parcel;
use crate::problem::Problem;

impl Problem {
    /// A parcel, whose mask has a bit for several pixels, as its receiver takes it. Others stay as they
    /// are.
    pub(crate) fn arriving(&self, mut parcel: Parcel) -> Parcel {
        let Some(through) = parcel.through else { return parcel };
        let block = &self.environments[parcel.environment as usize].block;
        let face = Face { bounds: self.space.grid.bounds(block), side: through };
        let slack = self.space.scene.tolerance();
        let source = &parcel.source;
        let hemisphere = self.hemisphere_of(&parcel.mask);
        let [tangent, bitangent, normal] = hemisphere.frame(source.centre, source.normal);
        let crosses = |pixel: &u32| {
            let d = hemisphere.directions[*pixel as usize];
            face.lets_in(source.centre, tangent * d.x + bitangent * d.y + normal * d.z, slack)
        };
        let mut cast = Mask::none(parcel.mask.pixels());
        parcel.mask.ones().filter(crosses).for_each(|pixel| cast.set(pixel));
        // At least those cross that have left; were it for rounding not so, all would be cast.
        let cast = if cast.is_empty() { parcel.mask.clone() } else { cast };
        let form_factor = hemisphere.form_factor(&cast);
        if form_factor > 0.0 {
            parcel.source.power *= parcel.form_factor / form_factor;
            (parcel.mask, parcel.form_factor) = (cast, form_factor);
        }
        parcel
    }
}

/// A side of a box.
struct Face {
    bounds: Bounds,
    side: Side,
}

impl Face {
    /// Whether a ray enters the box here, to within `slack` (m) at its edges.
    fn lets_in(&self, origin: DVec3, direction: DVec3, slack: f64) -> bool {
        let Face { bounds, side: Side { axis, upper } } = *self;
        let plane = if upper { bounds.max[axis] } else { bounds.min[axis] };
        let inwards = if upper { -direction[axis] } else { direction[axis] };
        let at = origin + direction * ((plane - origin[axis]) / direction[axis]);
        let within = |a: usize| at[a] >= bounds.min[a] - slack && at[a] <= bounds.max[a] + slack;
        inwards > 0.0 && (0..3).all(|a| a == axis || within(a))
    }
}
