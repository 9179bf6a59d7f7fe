//! Shots kept to be used again: within a run, across numbers of processors, from one sweep to the next.

use std::collections::BTreeMap;
use std::mem;
use std::ops::AddAssign;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use radiosity::Shot;

use super::helpers::Helpers;
use super::memory::Memory;
use super::meter::{ShotMeter, timed};
use super::shot_code::{decode, encode};
use super::shot_key::ShotKey;
use super::waiters::Waiters;
use crate::problem::{Problem, Source};

/// Shots of one problem. A shot depends on geometry alone, so results with and without kept shots are the
/// same, whatever was cast ahead.
///
/// Shots are kept until memory is full; later ones are cast each time, or found in the archive. None is
/// evicted: a sweep asks for the same shots again and again in much the same order, so that an evicted shot
/// would be asked for before the one that replaced it. With room for half of a scene's shots, Table 1 finds
/// 44 % of the shots that it asks for; with eviction of the least recently used 0 %, of a random one 19 %;
/// with room for all 87 %.
pub struct KeptShots {
    memory: Arc<Memory>,
    archive: Option<Box<dyn Archive>>,
    helpers: Arc<Helpers>,
    meter: Option<Arc<ShotMeter>>,
    table: Mutex<Table>,
    /// Threads that wait for a shot that another thread is casting.
    arrived: Waiters,
}

/// Where shots are kept beyond memory and beyond the end of this process.
pub trait Archive: Send + Sync {
    /// The bytes of a shot, if it is there undamaged.
    fn find(&self, key: &ShotKey) -> Option<Vec<u8>>;

    /// Keep a shot that it does not have yet.
    fn put(&self, key: &ShotKey, code: &[u8]);
}

/// What became of the shots that runs asked for. Each was found or cast.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShotCounts {
    /// Found in memory.
    pub in_memory: u64,
    /// Found in the archive.
    pub archived: u64,
    /// Cast, when asked for or ahead of it.
    pub cast: u64,
    /// Cast ahead and never asked for.
    pub in_vain: u64,
}

#[derive(Default)]
struct Table {
    entries: BTreeMap<ShotKey, Entry>,
    /// Bytes of shots that are there until they are asked for.
    ahead: usize,
    counts: ShotCounts,
}

enum Entry {
    /// Will be asked for; may be cast ahead of time.
    Foreseen,
    /// Being cast by a thread.
    Casting,
    There {
        code: Arc<[u8]>,
        /// What it counts as when it is asked for.
        found: Found,
        /// Whether memory was taken for it; else it is dropped once it has been asked for.
        kept: bool,
    },
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Found {
    InMemory,
    Archived,
    Cast,
}

/// The most bytes of shots cast ahead while memory for kept ones is full.
const MOST_AHEAD: usize = 16 << 20;

/// The memory of a kept shot beyond its bytes: key, entry, its part of the tree's nodes (two thirds full on
/// average), reference counts, the allocator's header.
const OVERHEAD: usize = (size_of::<ShotKey>() + size_of::<Entry>()) * 3 / 2 + 32;

impl KeptShots {
    /// Keep shots in `bytes` of memory.
    pub fn new(bytes: usize) -> KeptShots {
        KeptShots::sharing(&Arc::new(Memory::new(bytes)), &Arc::default(), None)
    }

    /// Keep shots in shared memory and in an archive; have them cast ahead by helpers.
    pub fn sharing(
        memory: &Arc<Memory>,
        helpers: &Arc<Helpers>,
        archive: Option<Box<dyn Archive>>,
    ) -> KeptShots {
        let (memory, helpers) = (Arc::clone(memory), Arc::clone(helpers));
        let (table, arrived) = (Mutex::default(), Waiters::default());
        KeptShots { memory, archive, helpers, meter: None, table, arrived }
    }

    /// The same, with the time measured for which runs wait for shots.
    pub fn measured(mut self, meter: &Arc<ShotMeter>) -> KeptShots {
        self.meter = Some(Arc::clone(meter));
        self
    }

    /// What became of the shots asked for so far.
    pub fn counts(&self) -> ShotCounts {
        let table = self.table();
        let cast_ahead = |entry: &&Entry| matches!(entry, Entry::There { found: Found::Cast, .. });
        let in_vain = table.entries.values().filter(cast_ahead).count() as u64;
        ShotCounts { in_vain, ..table.counts }
    }

    /// The threads that cast ahead.
    pub(crate) fn helpers(&self) -> &Helpers {
        &self.helpers
    }

    /// The shot of a source: a kept one, or cast now; and whether it had been asked for before.
    pub(crate) fn shot(&self, problem: &Problem, source: &Source) -> (Shot, bool) {
        let meter = self.meter.as_deref();
        match self.claim(ShotKey::of(source)) {
            Err(casting) => {
                meter.iter().for_each(|meter| meter.count());
                (timed(meter, || self.obtain(problem, source, casting, |_| ())), false)
            }
            Ok((code, found)) => {
                if found != Found::InMemory {
                    meter.iter().for_each(|meter| meter.count());
                }
                let environment = &problem.environments[source.environment as usize];
                let shot = decode(&code, environment, source.mask.pixels())
                    .unwrap_or_else(|_| problem.shoot(source));
                (shot, found == Found::InMemory)
            }
        }
    }

    /// Note that a shot will be asked for; whether it should be cast ahead.
    pub(crate) fn foresee(&self, source: &Source) -> bool {
        let key = ShotKey::of(source);
        let mut table = self.table();
        let new = !table.entries.contains_key(&key);
        if new {
            table.entries.insert(key, Entry::Foreseen);
        }
        new
    }

    /// Cast a foreseen shot, unless it has been asked for meanwhile or there is no room. `tell` is called with
    /// it before any other thread gets it.
    pub(crate) fn cast_ahead(&self, problem: &Problem, source: &Source, tell: impl FnOnce(&Shot)) {
        let key = ShotKey::of(source);
        {
            let mut table = self.table();
            let room = table.ahead < MOST_AHEAD;
            match table.entries.get_mut(&key) {
                Some(entry @ Entry::Foreseen) if room => *entry = Entry::Casting,
                _ => return,
            }
        }
        let casting = Casting { kept: self, key, ahead: true, done: None };
        self.obtain(problem, source, casting, tell);
    }

    /// The bytes of a shot and where they were found, or that the caller must obtain it.
    fn claim(&self, key: ShotKey) -> Result<(Arc<[u8]>, Found), Casting<'_>> {
        let mut table = self.table();
        loop {
            match table.entries.get_mut(&key) {
                None | Some(Entry::Foreseen) => {
                    table.entries.insert(key, Entry::Casting);
                    return Err(Casting { kept: self, key, ahead: false, done: None });
                }
                Some(Entry::There { code, found, kept }) => {
                    let (code, kept) = (Arc::clone(code), *kept);
                    let found = mem::replace(found, Found::InMemory);
                    table.counts.count(found);
                    if !kept {
                        table.entries.remove(&key);
                        table.ahead -= code.len() + OVERHEAD;
                    }
                    return Ok((code, found));
                }
                // While another thread casts it, do a job that waits.
                Some(Entry::Casting) => match self.helpers.take() {
                    Some(job) => {
                        drop(table);
                        timed(self.meter.as_deref(), job);
                        table = self.table();
                    }
                    None => table = timed(self.meter.as_deref(), || self.arrived.wait(table)),
                },
            }
        }
    }

    /// Take a shot from the archive or cast it.
    fn obtain(
        &self,
        problem: &Problem,
        source: &Source,
        mut casting: Casting,
        tell: impl FnOnce(&Shot),
    ) -> Shot {
        let key = casting.key;
        let environment = &problem.environments[source.environment as usize];
        let archived =
            self.archive.as_ref().and_then(|archive| archive.find(&key)).and_then(|code| {
                let shot = decode(&code, environment, source.mask.pixels()).ok()?;
                problem.closes(source, &shot).then_some((shot, code))
            });
        let (shot, code, found) = match archived {
            Some((shot, code)) => (shot, code, Found::Archived),
            None => {
                let shot = problem.shoot(source);
                let code = encode(&shot);
                self.archive.iter().for_each(|archive| archive.put(&key, &code));
                (shot, code, Found::Cast)
            }
        };
        tell(&shot);
        casting.done = Some((code.into(), found));
        shot
    }

    fn table(&self) -> MutexGuard<'_, Table> {
        self.table.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for KeptShots {
    fn drop(&mut self) {
        let kept = mem::take(&mut self.table().entries).into_values();
        let bytes = kept.map(|entry| match entry {
            Entry::There { code, kept: true, .. } => code.len() + OVERHEAD,
            _ => 0,
        });
        self.memory.give_back(bytes.sum());
    }
}

/// A shot that a thread is casting. Threads that wait for it are woken when it is dropped, also by a panic.
struct Casting<'a> {
    kept: &'a KeptShots,
    key: ShotKey,
    /// Whether it has not been asked for yet.
    ahead: bool,
    done: Option<(Arc<[u8]>, Found)>,
}

impl Drop for Casting<'_> {
    fn drop(&mut self) {
        let mut table = self.kept.table();
        table.entries.remove(&self.key);
        if let Some((code, mut found)) = self.done.take() {
            if !self.ahead {
                table.counts.count(found);
                found = Found::InMemory;
            }
            let bytes = code.len() + OVERHEAD;
            let kept = self.kept.memory.take(bytes);
            if !kept && self.ahead {
                table.ahead += bytes;
            }
            if kept || self.ahead {
                table.entries.insert(self.key, Entry::There { code, found, kept });
            }
        }
        drop(table);
        self.kept.arrived.notify_all();
    }
}

impl ShotCounts {
    /// Shots asked for.
    pub fn asked(&self) -> u64 {
        self.in_memory + self.archived + self.cast
    }

    fn count(&mut self, found: Found) {
        *match found {
            Found::InMemory => &mut self.in_memory,
            Found::Archived => &mut self.archived,
            Found::Cast => &mut self.cast,
        } += 1;
    }
}

impl AddAssign for ShotCounts {
    fn add_assign(&mut self, other: ShotCounts) {
        self.in_memory += other.in_memory;
        self.archived += other.archived;
        self.cast += other.cast;
        self.in_vain += other.in_vain;
    }
}
