//! Virtual walls in place of masks: `send_wall_patches` takes the place of sending masks.

use std::sync::Arc;

use radiosity::{Operation, Rgb, Shot, Work};

use super::compute_node::ComputeNode;
use super::process::{Process, Step};
use crate::problem::Source;
use crate::walls::WallPatch;
use crate::wire::Message;

impl ComputeNode {
    /// Gather what leaves the environment, then hand on the wall patches whose brightest bin is worth more than
    /// the best source that is left on this node.
    pub(super) async fn send_wall_patches(
        &mut self,
        process: &impl Process,
        source: &Source,
        shot: &Shot,
    ) {
        let mut work = Work::NONE;
        let pixels = self.walls.gather(&self.shared.problem, source, shot);
        work.count(Operation::Hit, pixels);
        let wall_patches =
            if self.selecting { self.take_wall_patches(&mut work) } else { Vec::new() };
        process.compute(Step::Gather, || ((), work)).await;
        for wall_patch in wall_patches {
            let sources = wall_patch.sources(&self.shared.problem);
            sources.iter().for_each(|source| self.hand_on(process, source));
            match self.shared.owners[wall_patch.environment as usize] {
                owner if owner == process.rank() => self.enqueue_all(process, sources),
                owner => {
                    self.send_source(process, owner, Message::WallPatch(Box::new(wall_patch)))
                        .await;
                }
            }
        }
    }

    /// Take the wall patches that are worth handing on.
    fn take_wall_patches(&mut self, work: &mut Work) -> Vec<WallPatch> {
        let shared = Arc::clone(&self.shared);
        let received = self.queue.best(None).map(|(value, _)| value);
        let local = self.region.best_patch(None).map(|best| best.value);
        let best = received.into_iter().chain(local).fold(0.0, f64::max);
        let worth = |[sum, brightest]: [Rgb; 2], area: f64| {
            let value = |power| shared.rules.selection.value_of(power, power / area);
            value(sum) >= shared.wall_threshold && value(brightest) >= best
        };
        work.count(Operation::PatchScan, self.walls.patches());
        let taken = self.walls.take(&shared.problem, worth);
        work.count(Operation::WordCopied, taken.iter().map(WallPatch::words).sum());
        taken
    }

    /// Put the bins of a wall patch into the queue, each a source.
    pub(super) fn enqueue_wall_patch(&mut self, process: &impl Process, wall_patch: &WallPatch) {
        self.enqueue_all(process, wall_patch.sources(&self.shared.problem));
    }

    fn enqueue_all(&mut self, process: &impl Process, sources: Vec<Source>) {
        sources.into_iter().map(Box::new).for_each(|source| self.enqueue(process, source));
    }
}
