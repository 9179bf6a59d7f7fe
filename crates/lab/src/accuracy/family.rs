//! All settings on one mesh, with their costs and errors as predicted from a few pilot runs.
//!
//! Runs that differ in one setting differ by its error and by the noise of their directions, which is known and
//! subtracted. The rest of the error that witnesses estimate is that of the mesh. Laws predict each cause for settings
//! that were not run: the error of directions falls with their number to the power 0.79, that of centre sampling with
//! the square of the parts' size, that of the mesh with the patches' size.

use crate::accuracy::pilot::{Knobs, Pilot, Pilots, threshold};
use crate::engine::error_figures::Causes;
use crate::engine::simulator::Stopped;

/// Exponent of the number of rays with which the error of the default directions falls.
const DIRECTIONS_POWER: f64 = 0.79;

/// Rays a source of the first pilots.
const FIRST_PIXELS: u32 = 1_024;

/// Most rays a source of any setting.
const MOST_PIXELS: u32 = 1 << 17;

/// Steps of the threshold: of the first pilot run, and at most.
const FIRST_STEPS: usize = 6;
const MOST_STEPS: usize = 48;

const OVERSHOOTS: [f64; 2] = [1.0, 1.3];

/// Sources a patch, along each direction, that are tried.
const SPLITS: [u32; 6] = [1, 2, 3, 4, 6, 8];

#[derive(Clone)]
pub struct Family {
    /// Edge of a patch over that of the experiment or the scene.
    pub mesh: f64,
    curves: Vec<Curve>,
    /// The error of the directions, and the number of pixels it belongs to.
    directions: (f64, u32),
    /// The error of shooting from centres of whole patches.
    centre: f64,
    /// The error of patches of one radiosity each.
    of_mesh: f64,
    /// Time of a run over that with the first number of pixels: a fixed part, and a part for each pixel.
    fixed: f64,
    a_pixel: f64,
    /// Factors by which errors without stopping, and times, were larger than predicted.
    error_correction: f64,
    time_correction: f64,
}

/// Error and time of stopping at each step of the threshold, with the first number of pixels.
#[derive(Clone)]
struct Curve {
    overshoot: f64,
    ambient: bool,
    /// Errors and seconds.
    steps: Vec<(f64, f64)>,
}

/// A setting with its predicted errors and time.
#[derive(Clone, Copy)]
pub struct Proposal {
    pub knobs: Knobs,
    pub step: usize,
    pub causes: Causes,
    /// Its virtual seconds on one processor.
    pub time_s: f64,
}

impl Family {
    /// Fits the laws of a mesh to pilot runs, as far as the target needs.
    pub fn explore(pilots: &Pilots, mesh: f64, target: f64) -> Result<Family, String> {
        let (split, threshold) = (1, threshold(0));
        let start =
            Knobs { mesh, pixels: FIRST_PIXELS, split, threshold, overshoot: 1.0, ambient: false };
        let (one, tail) = converged(pilots, &start, target)?;
        let steps = one.stops.len() - 1;
        let limit = pilots.solution(&one.stops[steps], true);
        let mut curves = Vec::new();
        for overshoot in OVERSHOOTS {
            let pilot = pilots.run(&Knobs { overshoot, ..start }, steps)?;
            for ambient in [false, true] {
                let step = |stop: &Stopped| {
                    let error = pilots.difference(&pilots.solution(stop, ambient), &limit);
                    (error + tail, stop.time_s)
                };
                let steps = pilot.stops.iter().take(steps + 1).map(step).collect();
                curves.push(Curve { overshoot, ambient, steps });
            }
        }
        // Other causes are measured where stopping contributes little.
        let plain = &curves[..2];
        let least =
            |step: usize| if plain[0].steps[step].0 < plain[1].steps[step].0 { 0 } else { 1 };
        let enough = |&step: &usize| plain[least(step)].steps[step].0 <= target / 2.0;
        let step = (0..steps).find(enough).unwrap_or(steps);
        let (stopping, ambient) = (plain[least(step)].steps[step].0, least(step) == 1);
        let at = |pilot: &Pilot| pilots.solution(&pilot.stops[step], ambient);

        let four = pilots.run(&Knobs { pixels: 4 * FIRST_PIXELS, ..start }, step)?;
        let coarse = pilots.difference(&at(&one), &at(&four)) / 1.0_f64.hypot(1.0 / fall(4.0));
        let directions = coarse / fall(4.0);
        let fine = at(&four);
        pilots.sharpen(&fine, target * target / 10.0);
        let known = directions * directions + stopping * stopping;
        let rest = (pilots.error(&fine).square - known).max(0.0).sqrt();
        // Sources cut in four, each with a quarter of the rays: a patch casts as many rays as before.
        let mut centre = 0.0;
        if rest > target / 4.0 {
            let cut = pilots.run(&Knobs { split: 2, ..start }, step)?;
            let noise = directions.hypot(coarse / 2.0);
            centre = (without(pilots.difference(&fine, &at(&cut)), noise) / 0.75).min(rest);
        }
        let [first, fourth] = [&one, &four].map(|pilot| pilot.stops[step].time_s);
        let a_pixel = (fourth / first - 1.0) / f64::from(3 * FIRST_PIXELS);
        Ok(Family {
            mesh,
            curves,
            directions: (directions, 4 * FIRST_PIXELS),
            centre,
            of_mesh: (rest * rest - centre * centre).sqrt(),
            fixed: 1.0 - a_pixel * f64::from(FIRST_PIXELS),
            a_pixel,
            error_correction: 1.0,
            time_correction: 1.0,
        })
    }

    /// Prediction for a mesh whose patches are `times` as long, without a pilot run there. Assumption: they are
    /// shot down to the same share, so that time is proportional to their number.
    pub fn scaled(&self, times: f64) -> Family {
        Family {
            mesh: self.mesh * times,
            centre: self.centre * times * times,
            of_mesh: self.of_mesh * times,
            time_correction: 1.0 / (times * times),
            ..self.clone()
        }
    }

    /// The error that remains whatever the directions and the threshold.
    pub fn rest(&self) -> f64 {
        self.centre.hypot(self.of_mesh)
    }

    /// All settings that can be predicted.
    pub fn settings(&self) -> impl Iterator<Item = Proposal> {
        let pixels = (0..).map(|i| (128.0 * 2.0_f64.powf(f64::from(i) / 2.0)) as u32);
        let pixels = pixels.take_while(|&pixels| pixels <= MOST_PIXELS);
        let cast = pixels.flat_map(|pixels| SPLITS.map(|split| (pixels, split)));
        cast.flat_map(move |(pixels, split)| {
            self.curves.iter().flat_map(move |curve| {
                (0..curve.steps.len()).map(move |step| self.setting(pixels, split, curve, step))
            })
        })
    }

    fn setting(&self, pixels: u32, split: u32, curve: &Curve, step: usize) -> Proposal {
        let &Curve { overshoot, ambient, .. } = curve;
        let (stopping, time_s) = curve.steps[step];
        let parts = f64::from(split);
        let rays = f64::from(pixels) / f64::from(self.directions.1);
        let times = (self.fixed + self.a_pixel * f64::from(pixels)) * parts * parts;
        let threshold = threshold(step);
        Proposal {
            knobs: Knobs { mesh: self.mesh, pixels, split, threshold, overshoot, ambient },
            step,
            causes: Causes {
                directions: self.error_correction * self.directions.0 / fall(rays) / parts,
                sampling: self.error_correction * self.centre / (parts * parts),
                mesh: self.error_correction * self.of_mesh,
                stopping,
            },
            time_s: time_s * times * self.time_correction,
        }
    }

    /// The same setting stopped at another step, with or without the ambient term, as far as it is known.
    pub fn stopped(&self, of: &Proposal, step: usize, ambient: bool) -> Option<Proposal> {
        let same = |c: &&Curve| c.overshoot == of.knobs.overshoot && c.ambient == ambient;
        let curve = self.curves.iter().find(same)?;
        (step < curve.steps.len())
            .then(|| self.setting(of.knobs.pixels, of.knobs.split, curve, step))
    }

    /// Corrects the laws by the squared error and the time of a setting that was run.
    pub fn learn(&mut self, proposal: &Proposal, square: f64, time_s: f64) {
        let Causes { stopping, .. } = proposal.causes;
        let predicted = Causes { stopping: 0.0, ..proposal.causes }.total();
        let found = (square - stopping * stopping).max(0.0).sqrt();
        self.error_correction *= (found / predicted.max(f64::MIN_POSITIVE)).clamp(0.5, 2.0);
        self.time_correction *= time_s / proposal.time_s;
    }
}

/// A pilot run that stops where little is left to shoot, and the estimated error of stopping there.
fn converged(
    pilots: &Pilots,
    knobs: &Knobs,
    target: f64,
) -> Result<(std::rc::Rc<Pilot>, f64), String> {
    let mut steps = FIRST_STEPS;
    loop {
        let pilot = pilots.run(knobs, steps)?;
        let stops = &pilot.stops;
        let last = stops.len() - 1;
        let back = |steps: usize| pilots.solution(&stops[last - steps], true);
        let (after, before) =
            (pilots.difference(&back(0), &back(2)), pilots.difference(&back(2), &back(4)));
        // Further changes shrink from halving to halving by the same factor, at least 0.5.
        let falls = if before > 0.0 { (after / before).clamp(0.5, 0.9) } else { 0.9 };
        let tail = after * falls / (1.0 - falls);
        // A halving that contains hardly any patch changes nothing.
        let [left, before] = [last, last - 2].map(|step| stops[step].unshot.abs());
        let enough = tail <= target / 4.0 && (left <= target || left < 0.9 * before);
        if enough || last >= MOST_STEPS {
            return Ok((pilot, tail));
        }
        steps = last + 4;
    }
}

/// Factor of the error of directions when rays are multiplied by a factor.
fn fall(times: f64) -> f64 {
    times.powf(DIRECTIONS_POWER)
}

/// A difference without its part from noise; at least a tenth of it, since the noise is an estimate too.
fn without(difference: f64, noise: f64) -> f64 {
    (difference * difference - noise * noise).max(0.01 * difference * difference).sqrt()
}
