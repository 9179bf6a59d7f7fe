//! A scene, meshed and cut: what all nodes of a run know from the start.

use radiosity::{
    Bounds, DepthBits, Emitter, Hemisphere, LocalEnvironment, Mask, Outgoing, Refinement, Rgb,
    Shot, Side, Space, VirtualWalls, shoot,
};

use super::decomposition::Decomposition;
use super::hemispheres::SmallerHemispheres;
use super::shooting::Shooting;
use super::source::Source;

/// A scene, meshed and cut. Runs on any number of processors share it.
pub struct Problem {
    /// The scene in its grid.
    pub space: Space,
    /// How space is cut.
    pub decomposition: Decomposition,
    /// The local environments by number.
    pub environments: Vec<LocalEnvironment>,
    /// The hemisphere over every source.
    pub hemisphere: Hemisphere,
    /// Hemispheres over dimmer sources.
    pub(super) smaller_hemispheres: SmallerHemispheres,
    /// Where a pilot run made the mesh finer, if there was one.
    pub refinement: Option<Refinement>,
    /// Virtual walls between environments; without them masks carry the light across.
    pub walls: Option<VirtualWalls>,
    /// Size of the integers of masks in a scene with participating media.
    pub depth_bits: DepthBits,
}

impl Problem {
    /// The same problem with virtual walls in place of masks.
    pub fn with_walls(self, walls: VirtualWalls) -> Problem {
        Problem { walls: Some(walls), ..self }
    }

    /// The same problem with integers of another size in the masks of a scene with media.
    pub fn with_depth_bits(self, depth_bits: DepthBits) -> Problem {
        Problem { depth_bits, ..self }
    }

    /// The same problem with these hemispheres over dimmer sources, each smaller than the problem's own.
    pub fn with_smaller_hemispheres(self, smaller: Vec<Hemisphere>) -> Problem {
        let brightest = self.brightest(|power, _| power.element_sum());
        let ray_power = brightest / f64::from(self.hemisphere.pixels());
        Problem { smaller_hemispheres: SmallerHemispheres::new(smaller, ray_power), ..self }
    }

    /// The greatest value of any patch before the first shot, by its power, W, and radiosity, W/m².
    pub fn brightest(&self, value: impl Fn(Rgb, Rgb) -> f64) -> f64 {
        let values = self.environments.iter().flat_map(|environment| {
            (0..environment.patches.len() as u32).map(|patch| {
                let power = environment.emitted_power(&self.space, patch);
                value(power, power / environment.radiosity_area(patch))
            })
        });
        values.fold(0.0, f64::max)
    }

    /// The hemisphere over a source of this power, W.
    pub fn hemisphere_for(&self, power: Rgb) -> &Hemisphere {
        self.smaller_hemispheres.for_power(power).unwrap_or(&self.hemisphere)
    }

    /// The hemisphere that a mask belongs to.
    pub fn hemisphere_of(&self, mask: &Mask) -> &Hemisphere {
        self.smaller_hemispheres.of_mask(mask).unwrap_or(&self.hemisphere)
    }

    /// All hemispheres, the largest first.
    pub(crate) fn hemispheres(&self) -> impl Iterator<Item = &Hemisphere> {
        [&self.hemisphere].into_iter().chain(self.smaller_hemispheres.all())
    }

    /// The rays over an emitter, one for each pixel of its mask.
    pub(crate) fn rays_of(&self, emitter: &Emitter, mask: &Mask) -> &Hemisphere {
        let of_wall = self.walls.as_ref().and_then(|walls| walls.rays_of(emitter));
        of_wall.unwrap_or_else(|| self.hemisphere_of(mask))
    }

    /// The sources that a patch with unshot power becomes (Figure 2): one at its centre with an all-true
    /// mask, or several where a patch is cut. `shot` is the number of the shot.
    pub(crate) fn sources_of(
        &self,
        shot: u32,
        emitter: Emitter,
        shooting: &Shooting,
    ) -> Vec<Source> {
        let environment = emitter.environment;
        let geometry = &self.environments[environment as usize];
        let emitted = geometry.emitted_power(&self.space, emitter.patch);
        let power = emitter.power * shooting.share(emitted);
        let parts = shooting.split.parts(&self.space, geometry, emitter.patch);
        let source = |part: radiosity::Part| {
            let emitter = Emitter { centre: part.centre, power: power * part.share, ..emitter };
            Source { environment, shot, emitter, mask: self.clear_mask(power), form_factor: 1.0 }
        };
        parts.into_iter().map(source).collect()
    }

    /// The mask that a patch shoots this power with, W: all visible, nothing dimmed (§3.3).
    fn clear_mask(&self, power: Rgb) -> Mask {
        let mask = Mask::all(self.hemisphere_for(power).pixels());
        let dims = !self.space.scene.media.is_empty() && self.walls.is_none();
        if dims { mask.with_depths(self.depth_bits) } else { mask }
    }

    /// Cast the rays of a source.
    pub fn shoot(&self, source: &Source) -> Shot {
        let Source { environment, emitter, mask, .. } = source;
        let environment = &self.environments[*environment as usize];
        shoot(&self.space, environment, self.rays_of(emitter, mask), emitter, mask)
    }

    /// Whether what a shot hits and what leaves it are the whole source, and no part is negative. Casting makes no
    /// other shots; an archive may hold some.
    pub fn closes(&self, source: &Source, shot: &Shot) -> bool {
        let Source { emitter, mask, .. } = source;
        let hits = shot.hits.iter().map(|(_, form_factor)| *form_factor);
        let outgoing = shot.outgoing.iter().flatten().map(|outgoing| outgoing.form_factor);
        let parts = hits.chain(outgoing).chain([shot.backs, shot.escaped, shot.medium]);
        let (mut sum, mut least) = (0.0, 0.0_f64);
        for part in parts {
            sum += part;
            least = least.min(part);
        }
        let whole = match mask.steps() {
            // What is left of these rays is not known here.
            Some(_) => sum.min(1.0),
            None => self.rays_of(emitter, mask).form_factor(mask),
        };
        least >= 0.0 && (sum - whole).abs() <= 1e-9
    }

    /// A source with what is left of its mask, for each neighbour that it enters (§4.2.3); for none where
    /// virtual walls gather what leaves.
    pub fn onward(&self, source: &Source, shot: &Shot) -> impl Iterator<Item = Source> {
        let Source { environment: from, shot: number, emitter, .. } = *source;
        let masks = self.walls.is_none();
        Side::ALL.into_iter().zip(&shot.outgoing).filter_map(move |(side, outgoing)| {
            let Outgoing { mask, form_factor } = outgoing.as_ref().filter(|_| masks)?;
            let environment = self.decomposition.neighbour(from, side);
            let (mask, form_factor) = (mask.clone(), *form_factor);
            Some(Source { environment, shot: number, emitter, mask, form_factor })
        })
    }

    /// The number of patches in all environments.
    pub fn patches(&self) -> usize {
        self.environments.iter().map(|e| e.patches.len()).sum()
    }

    /// The box of an environment.
    pub(crate) fn bounds(&self, environment: u32) -> Bounds {
        self.space.grid.bounds(&self.environments[environment as usize].block)
    }

    /// Power that the scene emits, W.
    pub fn emitted_power(&self) -> Rgb {
        let power = |e: &LocalEnvironment| -> Rgb {
            (0..e.patches.len() as u32).map(|p| e.emitted_power(&self.space, p)).sum()
        };
        self.environments.iter().map(power).sum()
    }
}
