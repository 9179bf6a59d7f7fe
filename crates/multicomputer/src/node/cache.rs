//! A processor's data caches, line by line, and its translation look-aside buffer, page by page.

/// One level of a memory hierarchy.
#[derive(Clone, Debug, PartialEq)]
pub struct CacheLevel {
    /// Its capacity, bytes.
    pub size: u64,
    /// Bytes that a miss loads.
    pub line: u64,
    /// Associativity: the lines of a set, of which the least recently used one is replaced.
    pub ways: u64,
    /// Seconds by which a miss is slower than a hit if the next level has the line.
    pub miss_time: f64,
}

/// The contents of one processor's caches, and their misses so far.
#[derive(Clone, Debug)]
pub struct Caches {
    levels: Vec<Cache>,
    translations: Option<Translations>,
}

#[derive(Clone, Debug)]
struct Cache {
    level: CacheLevel,
    /// Log2 of a line's bytes, and the number of sets less one.
    line: u32,
    sets: u64,
    /// The line in each way of each set, the most recently used one first.
    held: Vec<u64>,
    misses: u64,
}

/// The translation look-aside buffer: a cache of pages with one set. It has too many ways for a sorted
/// list, so it stores the time of each page's last use.
#[derive(Clone, Debug)]
struct Translations {
    level: CacheLevel,
    shift: u32,
    /// When each page was used last; 0 for those that are not in the buffer.
    used: Vec<u64>,
    known: Vec<usize>,
    now: u64,
    misses: u64,
}

/// No valid line has this number.
const NONE: u64 = u64::MAX;

impl Caches {
    /// Empty caches, the nearest level first, and an empty look-aside buffer, if there is one.
    pub fn new(levels: &[CacheLevel], translations: Option<&CacheLevel>) -> Caches {
        let levels = levels.iter().map(Cache::new).collect();
        Caches { levels, translations: translations.map(Translations::new) }
    }

    /// Reads or writes some bytes, at least one.
    #[inline]
    pub fn touch(&mut self, address: u64, bytes: u64) {
        if let Some(pages) = &mut self.translations {
            (address >> pages.shift..=(address + bytes - 1) >> pages.shift)
                .for_each(|p| pages.touch(p));
        }
        let Some((first, next)) = self.levels.split_first_mut() else { return };
        for line in address >> first.line..=(address + bytes - 1) >> first.line {
            if !first.touch(line) {
                let address = line << first.line;
                next.iter_mut().all(|cache| !cache.touch(address >> cache.line));
            }
        }
    }

    /// Misses of each level so far.
    pub fn misses(&self) -> impl Iterator<Item = u64> + '_ {
        self.levels.iter().map(|cache| cache.misses)
    }

    /// Misses of the translation look-aside buffer so far.
    pub fn untranslated(&self) -> u64 {
        self.translations.as_ref().map_or(0, |pages| pages.misses)
    }

    /// Seconds that all cache misses so far cost.
    pub fn time(&self) -> f64 {
        self.levels.iter().map(|cache| cache.misses as f64 * cache.level.miss_time).sum()
    }

    /// Seconds that all misses of the look-aside buffer so far cost.
    pub fn translating_time(&self) -> f64 {
        self.translations.as_ref().map_or(0.0, |pages| pages.misses as f64 * pages.level.miss_time)
    }
}

impl Cache {
    fn new(level: &CacheLevel) -> Cache {
        Cache {
            line: level.line.trailing_zeros(),
            sets: level.size / level.line / level.ways - 1,
            held: vec![NONE; (level.size / level.line) as usize],
            misses: 0,
            level: level.clone(),
        }
    }

    /// Uses a line. Returns whether it was there.
    #[inline]
    fn touch(&mut self, line: u64) -> bool {
        let ways = self.level.ways as usize;
        let first = (line & self.sets) as usize * ways;
        let held = &mut self.held[first..first + ways];
        if held[0] == line {
            return true;
        }
        let found = held.iter().position(|&other| other == line);
        let gone = found.unwrap_or(held.len() - 1);
        held[..=gone].rotate_right(1);
        held[0] = line;
        self.misses += u64::from(found.is_none());
        found.is_some()
    }
}

impl Translations {
    fn new(level: &CacheLevel) -> Translations {
        let shift = level.line.trailing_zeros();
        let (level, used, known) = (level.clone(), Vec::new(), Vec::new());
        Translations { level, shift, used, known, now: 0, misses: 0 }
    }

    /// Uses a page.
    #[inline]
    fn touch(&mut self, page: u64) {
        let page = page as usize;
        self.now += 1;
        if page >= self.used.len() {
            self.used.resize(page + 1, 0);
        }
        if self.used[page] == 0 {
            self.misses += 1;
            let room = (self.known.len() as u64) < self.level.ways;
            let oldest = (0..self.known.len()).min_by_key(|&place| self.used[self.known[place]]);
            match oldest.filter(|_| !room) {
                Some(place) => self.used[std::mem::replace(&mut self.known[place], page)] = 0,
                None => self.known.push(page),
            }
        }
        self.used[page] = self.now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(size: u64, line: u64, ways: u64) -> CacheLevel {
        CacheLevel { size, line, ways, miss_time: 1.0 }
    }

    fn misses(levels: &[CacheLevel], touches: &[(u64, u64)]) -> Vec<u64> {
        let mut caches = Caches::new(levels, None);
        touches.iter().for_each(|&(address, bytes)| caches.touch(address, bytes));
        caches.misses().collect()
    }

    #[test]
    fn lines_of_one_set_displace_each_other_where_there_is_one_way() {
        let touches = [(0, 8), (256, 8), (0, 8), (256, 8)];
        assert_eq!(misses(&[level(256, 32, 1)], &touches), [4]);
        assert_eq!(misses(&[level(256, 32, 2)], &touches), [2]);
    }

    #[test]
    fn the_least_recently_used_line_makes_room() {
        let touches = [(0, 1), (128, 1), (0, 1), (256, 1), (0, 1), (128, 1)];
        assert_eq!(misses(&[level(256, 32, 2)], &touches), [4]);
    }

    /// Compared with a list of pages in order of use, searched linearly.
    #[test]
    fn the_look_aside_buffer_holds_the_pages_used_last() {
        let pages = level(64 * 8_192, 8_192, 64);
        let mut caches = Caches::new(&[level(256, 32, 1)], Some(&pages));
        let (mut held, mut expected, mut random) = (Vec::new(), 0, 1_u64);
        for _ in 0..20_000 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            // Half of them in 16 pages, the others in 128.
            let page = (random >> 33) % if random >> 63 == 0 { 16 } else { 128 };
            caches.touch(page * 8_192 + (random >> 40) % 8_000, 8);
            let found = held.iter().position(|&other| other == page);
            expected += u64::from(found.is_none());
            found.map(|place| held.remove(place));
            held.push(page);
            held.drain(..held.len().saturating_sub(64));
        }
        assert!(1_000 < expected && expected < 10_000, "{expected}");
        assert_eq!(caches.untranslated(), expected);
        assert_eq!(caches.translating_time(), expected as f64);
    }

    #[test]
    fn a_touch_across_pages_needs_the_translations_of_all() {
        let mut caches = Caches::new(&[], Some(&level(4 * 64, 64, 4)));
        caches.touch(60, 70);
        assert_eq!(caches.untranslated(), 3);
    }

    #[test]
    fn a_touch_takes_every_line_that_it_reaches_into_and_the_next_level_sees_misses_alone() {
        let levels = [level(128, 16, 1), level(1024, 64, 1)];
        assert_eq!(misses(&levels, &[(8, 64), (8, 64)]), [5, 2]);
        assert_eq!(misses(&levels, &[(0, 16), (128, 16), (0, 16)]), [3, 2]);
    }
}
