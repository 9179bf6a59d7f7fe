//! The light in one environment: what its patches hold and what became of the rest.

use crate::mesh::{LocalEnvironment, Space};
use crate::scene::Rgb;
use crate::shoot::{Emitter, Shot};

/// Radiosity and unshot power of the patches of one environment, and where energy went.
#[derive(Clone, Debug)]
pub struct Light {
    /// Power that each patch has sent or will send out, W: emitted and reflected.
    pub leaving: Vec<Rgb>,
    /// The part of it that was not shot yet, W: the delta-radiosity times the area.
    pub unshot: Vec<Rgb>,
    /// Power absorbed by patches and by backs of polygons, W.
    pub absorbed: Rgb,
    /// Power that left the scene from here, W.
    pub escaped: Rgb,
    /// Power absorbed by participating media, W.
    pub medium: Rgb,
    reflectance: Vec<Rgb>,
}

impl Light {
    /// Before the first shot: everything emitted is unshot.
    pub fn new(space: &Space, environment: &LocalEnvironment) -> Light {
        let patches = 0..environment.patches.len() as u32;
        let emitted: Vec<Rgb> = patches.map(|p| environment.emitted_power(space, p)).collect();
        let reflectance = environment.patches.iter().map(|patch| {
            space.scene.material(&space.scene.polygons[patch.polygon as usize]).reflectance
        });
        Light {
            leaving: emitted.clone(),
            unshot: emitted,
            absorbed: Rgb::ZERO,
            escaped: Rgb::ZERO,
            medium: Rgb::ZERO,
            reflectance: reflectance.collect(),
        }
    }

    /// Take the unshot power of a patch, to be shot as a source.
    pub fn take_emitter(
        &mut self,
        space: &Space,
        environment: &LocalEnvironment,
        number: u32,
        patch: u32,
    ) -> Emitter {
        let source = self.emitter(space, environment, number, patch);
        self.unshot[patch as usize] = Rgb::ZERO;
        source
    }

    /// The source that a patch of environment `number` would be now.
    pub fn emitter(
        &self,
        space: &Space,
        environment: &LocalEnvironment,
        number: u32,
        patch: u32,
    ) -> Emitter {
        let power = self.unshot[patch as usize];
        let geometry = environment.patches[patch as usize];
        Emitter {
            environment: number,
            patch,
            polygon: geometry.polygon,
            centre: geometry.centre,
            normal: space.scene.polygons[geometry.polygon as usize].plane.normal,
            power,
            radiosity: power / environment.radiosity_area(patch),
        }
    }

    /// Update the patches with what a shot brought them (§3.3: one iteration of a progressive
    /// radiosity algorithm). Returns the power that they reflect of it, W.
    pub fn receive(&mut self, source: &Emitter, shot: &Shot) -> Rgb {
        let mut all_reflected = Rgb::ZERO;
        for &(patch, form_factor) in &shot.hits {
            let patch = patch as usize;
            let arriving = source.power * form_factor;
            let reflected = arriving * self.reflectance[patch];
            self.leaving[patch] += reflected;
            self.unshot[patch] += reflected;
            self.absorbed += arriving - reflected;
            all_reflected += reflected;
        }
        self.absorbed += source.power * shot.backs;
        self.escaped += source.power * shot.escaped;
        self.medium += source.power * shot.medium;
        all_reflected
    }

    /// Radiosity of a patch, W/m².
    pub fn radiosity(&self, environment: &LocalEnvironment, patch: u32) -> Rgb {
        self.leaving[patch as usize] / environment.radiosity_area(patch)
    }

    /// Sum of unshot power, W.
    pub fn unshot_power(&self) -> Rgb {
        self.unshot.iter().sum()
    }
}
