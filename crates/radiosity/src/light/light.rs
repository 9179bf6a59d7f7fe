//! The light in one environment: radiosity and unshot power of its patches, and its energy balance.

use crate::mesh::{LocalEnvironment, Patch, Space};
use crate::scene::Rgb;
use crate::shoot::{Emitter, Shot};

/// Radiosity and unshot power of the patches of one environment, and its energy balance.
#[derive(Clone, Debug)]
pub struct Light {
    /// Emitted and reflected power of each patch, shot or not, W: radiosity × area.
    pub leaving: Vec<Rgb>,
    /// The part of it that was not shot yet, W: delta-radiosity × area.
    pub unshot: Vec<Rgb>,
    /// Power absorbed by patches and by the backs of polygons, W.
    pub absorbed: Rgb,
    /// Power that left the scene from here, W.
    pub escaped: Rgb,
    /// Power absorbed by participating media, W.
    pub medium: Rgb,
    reflectance: Vec<Rgb>,
}

impl Light {
    /// The light before the first shot: all emitted power is unshot.
    pub fn new(space: &Space, environment: &LocalEnvironment) -> Light {
        let patches = 0..environment.patches.len() as u32;
        let emitted: Vec<Rgb> = patches.map(|p| environment.emitted_power(space, p)).collect();
        let reflectance = |patch: &Patch| space.scene.material_of(patch.polygon).reflectance;
        Light {
            leaving: emitted.clone(),
            unshot: emitted,
            absorbed: Rgb::ZERO,
            escaped: Rgb::ZERO,
            medium: Rgb::ZERO,
            reflectance: environment.patches.iter().map(reflectance).collect(),
        }
    }

    /// A patch of environment `number` as an emitter of its current unshot power.
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

    /// Updates the patches with the light of a shot, and returns the power that they reflect of it,
    /// W.
    ///
    /// Paper: §3.3, one iteration of a progressive radiosity algorithm.
    pub fn receive(&mut self, emitter: &Emitter, shot: &Shot) -> Rgb {
        let mut all_reflected = Rgb::ZERO;
        for &(patch, form_factor) in &shot.hits {
            let patch = patch as usize;
            let arriving = emitter.power * form_factor;
            let reflected = arriving * self.reflectance[patch];
            self.leaving[patch] += reflected;
            self.unshot[patch] += reflected;
            self.absorbed += arriving - reflected;
            all_reflected += reflected;
        }
        self.absorbed += emitter.power * shot.backs;
        self.escaped += emitter.power * shot.escaped;
        self.medium += emitter.power * shot.medium;
        all_reflected
    }

    /// Radiosity of a patch, W/m².
    pub fn radiosity(&self, environment: &LocalEnvironment, patch: u32) -> Rgb {
        self.leaving[patch as usize] / environment.radiosity_area(patch)
    }

    /// Total unshot power, W.
    pub fn unshot_power(&self) -> Rgb {
        self.unshot.iter().sum()
    }
}
