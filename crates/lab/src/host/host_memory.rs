//! Free memory of the host.

use std::fs;

/// Half of the memory that is free, bytes. If the system does not say, 1 GiB.
pub fn half_of_free_memory() -> usize {
    let free = [available(), left_to_group()].into_iter().flatten().min();
    free.map_or(1 << 30, |free| free / 2)
}

/// What Linux could give without swapping.
fn available() -> Option<usize> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: usize = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

/// What is left to a container, if its memory has a limit (Linux's control groups, version 2).
fn left_to_group() -> Option<usize> {
    let read = |name: &str| -> Option<usize> {
        fs::read_to_string(format!("/sys/fs/cgroup/memory.{name}")).ok()?.trim().parse().ok()
    };
    Some(read("max")?.saturating_sub(read("current")?))
}
