//! Finds the cheapest setting whose estimated error stays below a target.
//!
//! Laws fitted to a few cheap pilot runs predict error and time of all settings. The cheapest that is predicted to
//! reach the target is run, witnesses estimate its error, and the result corrects the predictions, until no
//! setting is predicted to be cheaper.

use crate::accuracy::family::{Family, Proposal};
use crate::accuracy::pilot::{Knobs, Pilots};
use crate::accuracy::tuned::Tuned;

/// Predicted errors are to stay below this share of the target.
const AIM: f64 = 0.9;

/// Standard error of the estimated squared error, as a share of the squared target.
const SURENESS: f64 = 0.05;

/// Standard errors by which the estimate must be below the target.
const SURE: f64 = 3.0;

/// Predicted cost of another trial, over that of the cheapest setting found, at most.
const WORTH_WHILE: f64 = 0.9;

/// Most settings that are tried.
const MOST_TRIALS: usize = 12;

/// Steps of the threshold that a trial goes on beyond the proposed one.
const FURTHER: usize = 2;

/// A search under way.
struct Search<'a> {
    pilots: &'a Pilots<'a>,
    target: f64,
    families: Vec<Family>,
    /// Settings tried, and down to which step.
    tried: Vec<(Knobs, usize)>,
    best: Option<Tuned>,
    /// The least error estimated by witnesses, or else predicted.
    least: f64,
}

/// The cheapest setting.
///
/// # Errors
/// Why a pilot did not end, or how near to the target the scene can be brought.
pub fn tune(pilots: &Pilots, target: f64) -> Result<Tuned, String> {
    let families = families(pilots, target)?;
    let (tried, best, least) = (Vec::new(), None, f64::INFINITY);
    let mut search = Search { pilots, target, families, tried, best, least };
    for _ in 0..MOST_TRIALS {
        let Some((family, proposal)) = search.propose() else { break };
        search.attempt(family, &proposal)?;
    }
    let Search { best, least, .. } = search;
    let tuned = best.map(|best| Tuned { pilots: pilots.count.get(), ..best });
    tuned.ok_or_else(|| {
        format!("{target}; expected at least {least:.1e}, what pilot runs say can be reached here")
    })
}

/// On the mesh that is asked for, on coarser ones while they do not spoil all, and on finer ones.
fn families(pilots: &Pilots, target: f64) -> Result<Vec<Family>, String> {
    let mut families = vec![Family::explore(pilots, 1.0, target)?];
    for mesh in [2.0, 4.0] {
        if families.last().is_some_and(|coarsest| coarsest.rest() < target / 2.0) {
            families.push(Family::explore(pilots, mesh, target)?);
        }
    }
    let finer = [0.5, 0.25].map(|mesh| families[0].scaled(mesh));
    families.extend(finer);
    Ok(families)
}

impl Search<'_> {
    /// The cheapest setting that is predicted to reach the target and was not tried, with its family.
    fn propose(&mut self) -> Option<(usize, Proposal)> {
        let enough = self.best.map_or(f64::INFINITY, |best| WORTH_WHILE * best.time_s);
        let mut cheapest: Option<(usize, Proposal)> = None;
        let mut least = f64::INFINITY;
        for (number, family) in self.families.iter().enumerate() {
            for proposal in family.settings() {
                let error = proposal.causes.total();
                least = least.min(error / AIM);
                let limit = cheapest.map_or(enough, |(_, other)| other.time_s);
                if error <= AIM * self.target && proposal.time_s < limit && self.is_new(&proposal) {
                    cheapest = Some((number, proposal));
                }
            }
        }
        if self.tried.is_empty() {
            self.least = least;
        }
        cheapest
    }

    fn is_new(&self, proposal: &Proposal) -> bool {
        let known = |(knobs, steps): &(Knobs, usize)| {
            knobs.casts_as(&proposal.knobs) && *steps >= proposal.step
        };
        !self.tried.iter().any(known)
    }

    /// Runs a setting and evaluates it at every step where it might stop.
    fn attempt(&mut self, family: usize, proposal: &Proposal) -> Result<(), String> {
        let Search { pilots, target, .. } = *self;
        let squared = target * target;
        let steps = proposal.step + FURTHER;
        let pilot = pilots.run(&proposal.knobs, steps)?;
        let stop = &pilot.stops[proposal.step];
        let proposed = pilots.solution(stop, proposal.knobs.ambient);
        pilots.sharpen(&proposed, SURENESS * squared);
        self.families[family].learn(proposal, pilots.error(&proposed).square, stop.time_s);
        let family = &self.families[family];
        for (step, stop) in pilot.stops.iter().enumerate() {
            for ambient in [false, true] {
                let Some(setting) = family.stopped(proposal, step, ambient) else { continue };
                let said = pilots.error(&pilots.solution(stop, ambient));
                let surely = said.square + SURE * said.deviation;
                self.least = self.least.min(surely.max(0.0).sqrt());
                let cheaper = self.best.is_none_or(|best| stop.time_s < best.time_s);
                if surely <= squared && cheaper {
                    let error = said.error();
                    self.best = Some(Tuned {
                        target,
                        knobs: setting.knobs,
                        error,
                        // The square's standard error, as one of the error itself.
                        deviation: said.deviation / (2.0 * error.max(f64::MIN_POSITIVE)),
                        predicted: setting.causes,
                        time_s: stop.time_s,
                        sweep_time_s: None,
                        pilots: 0,
                    });
                }
            }
        }
        self.tried.push((proposal.knobs, steps));
        Ok(())
    }
}
