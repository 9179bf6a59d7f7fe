//! Progressive radiosity in one environment: the traditional approach (§5.2).

use super::greatest::Greatest;
use super::light::Light;
use crate::mesh::{LocalEnvironment, Space};
use crate::scene::Rgb;
use crate::shoot::{Hemisphere, Mask, shoot};

/// Repeatedly shoots the patch with the most unshot power, until not more than the fraction
/// `stop_below` of the emitted power is unshot or `most_shots` are done. Calls `watch` after each
/// shot with the unshot fraction. Returns the light and the number of shots.
///
/// `environment` must be the whole grid: light that leaves it is lost.
pub fn solve(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    stop_below: f64,
    most_shots: u64,
    mut watch: impl FnMut(f64),
) -> (Light, u64) {
    let mut light = Light::new(space, environment);
    let mut greatest = Greatest::new(light.unshot.iter().map(|power| power.element_sum()));
    let mut left = light.unshot_power().element_sum();
    let emitted = left;
    let mask = Mask::all(hemisphere.pixels());
    let mut shots = 0;
    while shots < most_shots && left > emitted * stop_below {
        let Some((power, patch)) = greatest.best() else { break };
        let emitter = light.emitter(space, environment, 0, patch);
        light.unshot[patch as usize] = Rgb::ZERO;
        let shot = shoot(space, environment, hemisphere, &emitter, &mask);
        left += light.receive(&emitter, &shot).element_sum() - power;
        greatest.set(patch, light.unshot[patch as usize].element_sum());
        for &(hit, _) in &shot.hits {
            greatest.set(hit, light.unshot[hit as usize].element_sum());
        }
        shots += 1;
        watch(left / emitted);
    }
    (light, shots)
}
