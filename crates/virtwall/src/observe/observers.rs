//! Several observers of one run.

use desim::Time;
use multicomputer::{Rank, Stall};
use radiosity::{Rgb, Shot};

use super::observer::{Activity, Observer, SentMessage, SharedObserver};
use crate::problem::Source;

/// Observers that are called one after the other.
pub struct Observers(pub Vec<SharedObserver>);

impl Observers {
    fn tell(&self, tell: impl Fn(&mut dyn Observer)) {
        self.0.iter().for_each(|observer| tell(&mut *observer.borrow_mut()));
    }
}

impl Observer for Observers {
    fn activity(&mut self, rank: Rank, activity: Activity, from: Time, to: Time) {
        self.tell(|one| one.activity(rank, activity, from, to));
    }

    fn sent(&mut self, now: Time, message: &SentMessage) {
        self.tell(|one| one.sent(now, message));
    }

    fn arrived(&mut self, now: Time, number: u64, stalls: &[Stall]) {
        self.tell(|one| one.arrived(now, number, stalls));
    }

    fn read(&mut self, now: Time, rank: Rank, number: u64) {
        self.tell(|one| one.read(now, rank, number));
    }

    fn selected(&mut self, now: Time, rank: Rank, source: &Source) {
        self.tell(|one| one.selected(now, rank, source));
    }

    fn shot(&mut self, now: Time, rank: Rank, source: &Source, shot: &Shot, reflected: Rgb) {
        self.tell(|one| one.shot(now, rank, source, shot, reflected));
    }

    fn queue(&mut self, now: Time, rank: Rank, length: usize) {
        self.tell(|one| one.queue(now, rank, length));
    }

    fn memory(&mut self, now: Time, rank: Rank, bytes: u64) {
        self.tell(|one| one.memory(now, rank, bytes));
    }
}
