//! Checks the caches of a machine file.

use config::{Fault, Place};

use super::file::{CachesFile, TranslationsFile};
use crate::node::CacheLevel;

/// Largest line and cache, bytes: larger ones must be mistakes.
const LONGEST_LINE: u64 = 65_536;
const LARGEST_CACHE: u64 = 1 << 30;
/// Shortest page, bytes, that of a VAX. The simulation counts the pages of the whole address space.
const SHORTEST_PAGE: u64 = 512;

/// The levels of a machine file. A line and a number of sets must be powers of two, and a line at least
/// as long as those of the level before.
pub(crate) fn levels(files: &CachesFile) -> Result<Vec<CacheLevel>, Fault> {
    let mut levels: Vec<CacheLevel> = Vec::new();
    let secondary = files.secondary.as_ref().map(|file| ("secondary", file));
    for (cache, file) in [("primary", &files.primary)].into_iter().chain(secondary) {
        let bytes = |name: &str, found: f64, unit: u64, most: u64| {
            let units = found / unit as f64;
            if units.fract() == 0.0 && (units as u64).is_power_of_two() && found <= most as f64 {
                return Ok(found as u64);
            }
            let place = format!("processor.caches.{cache}.{name}.value");
            let expected = format!("expected {unit} B times a power of two, at most {most} B");
            Err(Fault::at(Place::of(&place), format!("found {found} B; {expected}")))
        };
        let ways = u64::from(file.ways.value.get());
        let shortest = levels.last().map_or(1, |level| level.line);
        let line = bytes("line", file.line.si(), shortest, LONGEST_LINE)?;
        let size = bytes("size", file.size.si(), line * ways, LARGEST_CACHE)?;
        levels.push(CacheLevel { size, line, ways, miss_time: file.miss_time.si() });
    }
    Ok(levels)
}

/// The translation look-aside buffer, as a fully associative cache of pages.
pub(crate) fn translations(file: &TranslationsFile) -> Result<CacheLevel, Fault> {
    let (page, ways) = (file.page.si(), u64::from(file.entries.value.get()));
    let allowed = SHORTEST_PAGE as f64..=LONGEST_LINE as f64;
    if !allowed.contains(&page) || page.fract() != 0.0 || !(page as u64).is_power_of_two() {
        let expected = format!("a power of two, {SHORTEST_PAGE} to {LONGEST_LINE} B");
        let message = format!("found {page} B; expected {expected}");
        return Err(Fault::at(Place::of("processor.caches.translations.page.value"), message));
    }
    let line = page as u64;
    Ok(CacheLevel { size: line * ways, line, ways, miss_time: file.miss_time.si() })
}
