//! Finds the cheapest setting of the knobs whose estimated error stays below a target: no more than a
//! scene needs.
//!
//! Pilot runs tell each cause of error by itself: two runs that differ in one knob alone differ by the
//! error of that knob, and by the noise of their directions, which is known and taken off. Laws that
//! were measured elsewhere carry each of them to settings that were not run: directions fall with the
//! power 0.79 of their number, centre sampling with the square of the parts' size, meshes with the
//! patches' size.

use crate::pilot::{Knobs, Pilot, Pilots};
use crate::tuned::{Causes, Tuned};

/// By which power of the rays the error of the default directions falls.
const DIRECTIONS_POWER: f64 = 0.79;

/// The share of the target that estimates may reach: they are estimates.
const MARGIN: f64 = 0.8;

/// Rays a source of the first pilots.
const FIRST_PIXELS: u32 = 1_024;

/// The most rays a source of any.
const MOST_PIXELS: u32 = 1 << 17;

/// The share of the brightest patch that the first pilots stop at.
const FIRST_THRESHOLD: f64 = 0.1;

/// Halvings of that share at most.
const MOST_HALVINGS: usize = 24;

/// Where shooting may stop.
#[derive(Clone, Copy)]
struct Stop {
    threshold: f64,
    overshoot: f64,
    ambient: bool,
    error: f64,
    time_s: f64,
}

/// What the pilots say of each cause.
struct Estimates {
    stops: Vec<Stop>,
    /// The error of the directions with so many pixels.
    directions: (f64, u32),
    /// The error of shooting from centres, patches as asked for and whole.
    centre: f64,
    /// The error of patches so many times as long as asked for.
    meshes: [(f64, f64); 4],
    /// What a run takes in the mean on pixels of the first number, and what it takes for more.
    fixed: f64,
    a_pixel: f64,
    /// What a run takes on patches as asked for, over one on patches twice as long.
    mesh_ratio: f64,
}

/// The cheapest setting.
///
/// # Errors
/// Why a pilot did not end, or how near to the target the scene can be brought.
pub fn tune(pilots: &Pilots, target: f64) -> Result<Tuned, String> {
    let estimates = estimate(pilots, target)?;
    let mut best: Option<Tuned> = None;
    let mut least = f64::INFINITY;
    for tuned in estimates.settings() {
        let error = tuned.predicted.total();
        least = least.min(error);
        if error <= MARGIN * target && best.is_none_or(|best| tuned.time_s < best.time_s) {
            best = Some(tuned);
        }
    }
    let tuned = best.map(|best| Tuned { target, pilots: pilots.count(), ..best });
    tuned.ok_or_else(|| {
        let least = least / MARGIN;
        format!("{target}; expected at least {least:.1e}, what pilot runs say can be reached here")
    })
}

const START: Knobs = Knobs {
    mesh: 1.0,
    pixels: FIRST_PIXELS,
    split: 1,
    threshold: FIRST_THRESHOLD,
    overshoot: 1.0,
    ambient: false,
};

fn estimate(pilots: &Pilots, target: f64) -> Result<Estimates, String> {
    let stops = stops(pilots, target)?;
    // Other causes are looked at where stopping leaves about the target.
    let plain = stops.iter().filter(|stop| stop.overshoot == 1.0 && !stop.ambient);
    let enough = plain.clone().find(|stop| stop.error <= target).or(plain.clone().next_back());
    let knobs = Knobs { threshold: enough.map_or(FIRST_THRESHOLD, |stop| stop.threshold), ..START };
    let at = |mesh, split, pixels| pilots.run(&Knobs { mesh, split, pixels, ..knobs });

    let (one, four) = (at(1.0, 1, FIRST_PIXELS)?, at(1.0, 1, 4 * FIRST_PIXELS)?);
    let first = of_the_coarser(pilots.difference(&one, &four));
    let wanted = FIRST_PIXELS as f64 * (2.0 * first / target).powf(1.0 / DIRECTIONS_POWER);
    let pixels = (wanted as u32).next_power_of_two().clamp(4 * FIRST_PIXELS, MOST_PIXELS / 2);
    let (coarse, fine) = (at(1.0, 1, pixels / 4)?, at(1.0, 1, pixels)?);
    let directions = of_the_coarser(pilots.difference(&coarse, &fine)) / fall(4.0);

    // Sources cut in four, each with a quarter of the rays: what a patch shoots stays the same.
    let split = at(1.0, 2, pixels / 4)?;
    let noise = directions.hypot(directions * fall(4.0) / 2.0);
    let centre = without(pilots.difference(&fine, &split), noise) / 0.75;
    // The same sources on coarser and on finer receivers.
    let coarse_mesh = at(2.0, 2, pixels / 4)?;
    let coarser_by = without(pilots.difference(&coarse_mesh, &fine), noise);
    let noise = directions * fall(4.0) / 2.0;
    let fine_mesh = at(0.5, 1, pixels / 4)?;
    let mesh = without(pilots.difference(&split, &fine_mesh), noise.hypot(noise)) / 0.75;
    let coarser = pilots.run(&Knobs { mesh: 2.0, ..knobs })?;
    let a_pixel = (fine.time_s - one.time_s) / f64::from(pixels - FIRST_PIXELS) / one.time_s;
    Ok(Estimates {
        stops,
        directions: (directions, pixels),
        centre,
        meshes: [(2.0, coarser_by + mesh), (1.0, mesh), (0.5, mesh / 2.0), (0.25, mesh / 4.0)],
        fixed: 1.0 - a_pixel * f64::from(FIRST_PIXELS),
        a_pixel,
        mesh_ratio: one.time_s / coarser.time_s,
    })
}

/// By how much the error of directions falls with so many times the rays.
fn fall(times: f64) -> f64 {
    times.powf(DIRECTIONS_POWER)
}

/// The error of directions of the coarser of two runs, the finer with four times the rays, that differ by
/// `difference`: their errors know nothing of each other.
fn of_the_coarser(difference: f64) -> f64 {
    difference / 1.0_f64.hypot(1.0 / fall(4.0))
}

/// A difference without what noise does of it; never less than a tenth of it: the noise is an estimate
/// as well.
fn without(difference: f64, noise: f64) -> f64 {
    (difference * difference - noise * noise).max(0.01 * difference * difference).sqrt()
}

/// What stopping costs and spares, at each threshold, with and without overshooting and ambient term.
fn stops(pilots: &Pilots, target: f64) -> Result<Vec<Stop>, String> {
    let at = |halvings: usize, overshoot, ambient| {
        let threshold = FIRST_THRESHOLD / 2.0_f64.powi(halvings as i32);
        let knobs = Knobs { threshold, overshoot, ambient, ..START };
        pilots.run(&knobs).map(|pilot| (threshold, pilot))
    };
    let (_, mut last) = at(0, 1.0, false)?;
    let (mut halvings, mut tail) = (0, f64::INFINITY);
    // A halving that no patch lies in changes nothing, and says nothing.
    while halvings < MOST_HALVINGS && (tail > target / 10.0 || last.unshot > target) {
        halvings += 1;
        let (_, next) = at(halvings, 1.0, false)?;
        tail = pilots.difference(&last, &next);
        last = next;
    }
    let mut stops = Vec::new();
    for (overshoot, ambient) in [(1.0, false), (1.0, true), (1.3, false), (1.3, true)] {
        for halvings in 0..=halvings {
            let (threshold, pilot) = at(halvings, overshoot, ambient)?;
            let Pilot { time_s, .. } = *pilot;
            let error = pilots.difference(&pilot, &last) + tail;
            stops.push(Stop { threshold, overshoot, ambient, error, time_s });
        }
    }
    Ok(stops)
}

impl Estimates {
    /// All settings within reach.
    fn settings(&self) -> impl Iterator<Item = Tuned> {
        let pixels = (0..).map(|i| (128.0 * 2.0_f64.powf(f64::from(i) / 2.0)) as u32);
        let pixels = pixels.take_while(|&pixels| pixels <= MOST_PIXELS);
        let knobs = pixels.flat_map(|pixels| {
            self.meshes.into_iter().flat_map(move |mesh| {
                [1, 2, 3, 4, 6, 8].into_iter().map(move |split| (pixels, mesh, split))
            })
        });
        knobs.flat_map(move |(pixels, mesh, split)| {
            self.stops.iter().map(move |stop| self.setting(pixels, mesh, split, stop))
        })
    }

    fn setting(&self, pixels: u32, mesh: (f64, f64), split: u32, stop: &Stop) -> Tuned {
        let (mesh, of_mesh) = mesh;
        let &Stop { threshold, overshoot, ambient, error, time_s } = stop;
        let rays = f64::from(pixels) / f64::from(self.directions.1);
        let parts = f64::from(split);
        let time = (self.fixed + self.a_pixel * f64::from(pixels)) * parts * parts;
        Tuned {
            knobs: Knobs { mesh, pixels, split, threshold, overshoot, ambient },
            predicted: Causes {
                directions: self.directions.0 / fall(rays) / parts,
                centre: self.centre * (mesh / parts).powi(2),
                mesh: of_mesh,
                stopping: error,
            },
            time_s: time_s * time * self.mesh_ratio.powf(-mesh.log2()),
            target: 0.0,
            pilots: 0,
        }
    }
}
