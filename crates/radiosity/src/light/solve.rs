//! Progressive radiosity in one environment: the traditional approach (§5.2), and a reference.

use super::greatest::Greatest;
use super::light::Light;
use crate::mesh::{LocalEnvironment, Space};
use crate::shoot::{Hemisphere, Mask, shoot};

/// Shoot the patch with most unshot power again and again until less than `stop_below` of the
/// emitted power is left unshot, or `most_shots` are done. Returns the light and the shots it took.
///
/// `environment` must be the whole grid: what leaves it is lost.
pub fn solve(
    space: &Space,
    environment: &LocalEnvironment,
    hemisphere: &Hemisphere,
    stop_below: f64,
    most_shots: u64,
) -> (Light, u64) {
    solve_watched(space, environment, hemisphere, stop_below, most_shots, |_| ())
}

/// The same; `watch` is told, shot by shot, what part of the emitted power is left.
pub fn solve_watched(
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
        let source = light.take_emitter(space, environment, 0, patch);
        let shot = shoot(space, environment, hemisphere, &source, &mask);
        left += light.receive(&source, &shot).element_sum() - power;
        greatest.set(patch, light.unshot[patch as usize].element_sum());
        for &(hit, _) in &shot.hits {
            greatest.set(hit, light.unshot[hit as usize].element_sum());
        }
        shots += 1;
        watch(left / emitted);
    }
    (light, shots)
}
