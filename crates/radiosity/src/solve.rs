//! Progressive radiosity in one environment: the traditional approach (§5.2), and a reference.

use crate::environment::LocalEnvironment;
use crate::hemisphere::Hemisphere;
use crate::light::Light;
use crate::mask::Mask;
use crate::shoot::shoot;
use crate::space::Space;

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
    let mut light = Light::new(space, environment);
    let goal = light.unshot_power().element_sum() * stop_below;
    let mask = Mask::all(hemisphere.pixels());
    let mut shots = 0;
    while shots < most_shots && light.unshot_power().element_sum() > goal {
        let patches = light.unshot.iter().enumerate();
        let Some((patch, _)) =
            patches.reduce(
                |best, other| {
                    if other.1.element_sum() > best.1.element_sum() { other } else { best }
                },
            )
        else {
            break;
        };
        let source = light.take_source(space, environment, 0, patch as u32);
        let shot = shoot(space, environment, hemisphere, &source, &mask);
        light.receive(&source, &shot);
        shots += 1;
    }
    (light, shots)
}
