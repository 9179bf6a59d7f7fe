//! What is missing to a perfect speed-up, as a product of factors.

use super::analysed_run::AnalysedRun;
use crate::record::NodeState;

/// Factors whose product is the number of processors divided by the speed-up.
pub(super) struct Loss {
    /// Time on one processor or, where that is not known, the sum of all nodes' computing, seconds.
    pub base: f64,
    /// Work divided by the work on one processor.
    pub more: f64,
    /// The busiest node's work divided by the mean.
    pub uneven: f64,
    /// The run's time divided by the time that its busiest node computed.
    pub waits: f64,
}

impl Loss {
    /// `alone` is the same run on one processor, if that was recorded.
    pub fn of(run: &AnalysedRun, alone: Option<&AnalysedRun>) -> Loss {
        let work = run.all.computing();
        let busiest = run.nodes[run.busiest].computing();
        if busiest == 0.0 {
            return Loss { base: run.seconds(), more: 1.0, uneven: 1.0, waits: 1.0 };
        }
        let base = alone.map_or(work, AnalysedRun::seconds);
        let uneven = busiest * run.processors() as f64 / work;
        Loss { base, more: work / base, uneven, waits: run.seconds() / busiest }
    }

    /// In words, the factor that makes up more than half of the loss, if one does.
    pub fn verdict(&self, run: &AnalysedRun) -> &'static str {
        let busiest = &run.nodes[run.busiest];
        let whole = self.more * self.uneven * self.waits;
        let rest = [busiest.waiting(), busiest.overhead(), busiest.in_state(NodeState::Paging)];
        let most = rest.iter().copied().fold(0.0, f64::max);
        let waits = match rest.iter().position(|&part| part == most) {
            Some(1) => "Its busiest node spends its time on messages.",
            Some(2) => "Its busiest node spends its time paging.",
            _ => "Its busiest node waits for light from other nodes.",
        };
        let causes = [
            (self.more, "It does more work than one processor does."),
            (self.uneven, "The work is unevenly distributed over its nodes."),
            (self.waits, waits),
        ];
        let main = causes.iter().find(|(factor, _)| factor.ln() > 0.5 * whole.ln());
        match main {
            _ if whole < 1.25 => "Little is lost.",
            Some((_, cause)) => cause,
            None => "No single cause dominates.",
        }
    }
}
