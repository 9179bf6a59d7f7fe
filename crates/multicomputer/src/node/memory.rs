//! Memory of a node: which of a program's segments are resident, and what paging costs.

use std::collections::BTreeMap;

use desim::Duration;

/// The memory of every node of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeMemory {
    /// What the operating system leaves for the program and for message buffers, bytes.
    pub available: u64,
    /// Reserved for messages that have arrived and were not read, bytes. More such messages take
    /// room from the program.
    pub message_buffers: u64,
    /// What one page fault loads, bytes.
    pub burst: u64,
    /// Time of a page fault until its first byte is loaded.
    pub fault_time: Duration,
    /// Bytes a second at which the rest is loaded.
    pub bandwidth: f64,
    /// Bytes of each kind of record that programs allocate, by name.
    pub sizes: BTreeMap<String, u64>,
}

impl NodeMemory {
    /// Time to load `bytes` at consecutive addresses.
    pub fn page_in(&self, bytes: u64) -> Duration {
        self.fault_time * bytes.div_ceil(self.burst)
            + Duration::from_seconds_f64(bytes as f64 / self.bandwidth)
    }
}

/// The program's number for a part of its memory that is used, and paged, as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Segment(pub u64);

/// The allocated segments, and which of them are resident: the most recently used ones. So more memory
/// never means more page faults of the same program.
///
/// Paging out costs nothing here: the system cleans pages while the program goes on.
pub(crate) struct ResidentSet {
    memory: NodeMemory,
    /// All segments, with their bytes, and the number of their last use if they are resident.
    allocated: BTreeMap<Segment, (u64, Option<u64>)>,
    /// The resident ones, by last use.
    resident: BTreeMap<u64, Segment>,
    allocated_bytes: u64,
    resident_bytes: u64,
    unread_bytes: u64,
    uses: u64,
    high_water: u64,
}

impl ResidentSet {
    /// Empty memory.
    pub(crate) fn new(memory: &NodeMemory) -> ResidentSet {
        ResidentSet {
            memory: memory.clone(),
            allocated: BTreeMap::new(),
            resident: BTreeMap::new(),
            allocated_bytes: 0,
            resident_bytes: 0,
            unread_bytes: 0,
            uses: 0,
            high_water: 0,
        }
    }

    /// The most bytes in use at a time by program and message buffers.
    pub(crate) fn high_water(&self) -> u64 {
        self.high_water
    }

    /// Bytes that the program has allocated, resident or paged out.
    pub(crate) fn allocated_bytes(&self) -> u64 {
        self.allocated_bytes
    }

    /// The program allocates a segment.
    pub(crate) fn keep(&mut self, segment: Segment, bytes: u64) {
        self.release(segment);
        self.allocated.insert(segment, (bytes, None));
        self.allocated_bytes += bytes;
        self.page_in(segment);
    }

    /// The program uses a segment. Returns how long it waits for it.
    pub(crate) fn touch(&mut self, segment: Segment) -> Duration {
        let Some(&(bytes, used)) = self.allocated.get(&segment) else { return Duration::ZERO };
        if used.is_some() {
            self.page_out(segment);
        }
        self.page_in(segment);
        if used.is_some() { Duration::ZERO } else { self.memory.page_in(bytes) }
    }

    /// The program frees a segment.
    pub(crate) fn release(&mut self, segment: Segment) {
        self.page_out(segment);
        if let Some((bytes, _)) = self.allocated.remove(&segment) {
            self.allocated_bytes -= bytes;
        }
    }

    /// Sets the bytes of messages that have arrived and were not read.
    pub(crate) fn set_unread(&mut self, bytes: u64) {
        self.unread_bytes = bytes;
        self.make_room();
    }

    fn page_in(&mut self, segment: Segment) {
        if let Some((bytes, used)) = self.allocated.get_mut(&segment) {
            self.uses += 1;
            *used = Some(self.uses);
            self.resident.insert(self.uses, segment);
            self.resident_bytes += *bytes;
        }
        self.make_room();
    }

    fn page_out(&mut self, segment: Segment) {
        if let Some((bytes, used)) = self.allocated.get_mut(&segment)
            && let Some(used) = used.take()
        {
            self.resident.remove(&used);
            self.resident_bytes -= *bytes;
        }
    }

    /// Pages out until the rest fits, the segment just used included if it alone is too large.
    fn make_room(&mut self) {
        let buffers = self.unread_bytes.max(self.memory.message_buffers);
        self.high_water = self.high_water.max(self.allocated_bytes.saturating_add(buffers));
        let room = self.memory.available.saturating_sub(buffers);
        while self.resident_bytes > room
            && let Some((_, &oldest)) = self.resident.first_key_value()
        {
            self.page_out(oldest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn memory(available: u64) -> NodeMemory {
        NodeMemory {
            available,
            message_buffers: 10,
            burst: 8,
            fault_time: Duration::from_seconds_f64(1.0),
            bandwidth: 16.0,
            sizes: BTreeMap::new(),
        }
    }

    fn waits(available: u64, sizes: &[u64], uses: &[u64]) -> Duration {
        let mut resident = ResidentSet::new(&memory(available));
        for (name, &bytes) in (0..).zip(sizes) {
            resident.keep(Segment(name), bytes);
        }
        uses.iter().map(|&name| resident.touch(Segment(name))).sum()
    }

    #[test]
    fn the_least_recently_used_segment_is_paged_out() {
        // Room for 20 bytes: 0 goes when 2 comes, 1 when 0 comes back; 20 bytes are three faults.
        let seconds = |uses: &[u64]| waits(30, &[8, 8, 8], uses).as_seconds_f64();
        assert_eq!(seconds(&[2, 1, 2]), 0.0);
        assert_eq!(seconds(&[0, 2]), 1.5);
        assert_eq!(seconds(&[0, 1]), 3.0);
        assert_eq!(waits(30, &[20], &[0, 0]), Duration::ZERO);
        assert_eq!(waits(29, &[20], &[0, 0]).as_seconds_f64(), 2.0 * (3.0 + 20.0 / 16.0));
    }

    #[test]
    fn more_memory_never_costs_more() {
        let uses: Vec<u64> = (0..500_u64).map(|i| (i * i * 7 + i / 3) % 11).collect();
        let sizes: Vec<u64> = (0..11).map(|i| 3 + i * i % 17).collect();
        let costs: Vec<Duration> = (0..130).map(|room| waits(10 + room, &sizes, &uses)).collect();
        assert!(costs.is_sorted_by(|less_room, more_room| less_room >= more_room));
        assert!(costs[0] > costs[60] && costs[60] > costs[129]);
        assert_eq!(costs[129], Duration::ZERO);
    }

    #[test]
    fn unread_messages_take_room_from_the_program() {
        let mut resident = ResidentSet::new(&memory(30));
        resident.keep(Segment(0), 20);
        resident.set_unread(10);
        assert_eq!((resident.touch(Segment(0)), resident.high_water()), (Duration::ZERO, 30));
        resident.set_unread(11);
        resident.set_unread(0);
        assert_eq!(resident.high_water(), 31);
        assert!(resident.touch(Segment(0)) > Duration::ZERO);
        resident.release(Segment(0));
        resident.keep(Segment(1), 1);
        assert_eq!(resident.high_water(), 31);
    }
}
