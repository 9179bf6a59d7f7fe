//! The nearest full slot of each empty slot, in time linear in their number.

/// For each slot of a grid, `width` slots in a row, the place of the nearest full slot; of equally near ones
/// the first. `None` if no slot is full.
///
/// Meijster, Roerdink and Hesselink 2000: first the nearest full slot of each row, then for each column the
/// nearest of those.
pub(crate) fn nearest_full(full: &[bool], width: usize) -> Option<Vec<u32>> {
    let height = full.len() / width;
    let in_rows: Vec<Option<i64>> = full.chunks_exact(width).flat_map(nearest_in_row).collect();
    let mut places = vec![0; full.len()];
    let mut stretches = Vec::new();
    for column in 0..width {
        let at = |row: i64| in_rows[row as usize * width + column];
        stretches.clear();
        for row in 0..height as i64 {
            if let Some(at) = at(row) {
                push(&mut stretches, Row { row, away: (at - column as i64).pow(2) }, height as i64);
            }
        }
        let mut stretch = 0;
        for row in 0..height {
            while stretches.get(stretch + 1).is_some_and(|&(start, _)| start <= row as i64) {
                stretch += 1;
            }
            let (_, Row { row: nearest, .. }) = *stretches.get(stretch)?;
            places[row * width + column] = nearest as u32 * width as u32 + at(nearest)? as u32;
        }
    }
    Some(places)
}

/// A row with a full slot, and the square of the distance of its nearest full slot from the column.
#[derive(Clone, Copy)]
struct Row {
    row: i64,
    away: i64,
}

/// Adds a row below the others. Each entry has the first place in the column where it is the nearest.
fn push(stretches: &mut Vec<(i64, Row)>, new: Row, height: i64) {
    let mut start = 0;
    while let Some(&(before, old)) = stretches.last() {
        // Nearer than the old row from here on: of equally near ones the old row is the first.
        let (squares, rows) = (new.row.pow(2) - old.row.pow(2), new.row - old.row);
        start = (squares + new.away - old.away).div_euclid(2 * rows) + 1;
        if start > before {
            break;
        }
        stretches.pop();
        start = 0;
    }
    if start < height {
        stretches.push((start, new));
    }
}

/// The nearest full slot of the row for each slot; of equally near ones the first.
fn nearest_in_row(full: &[bool]) -> Vec<Option<i64>> {
    let mut nearest: Vec<Option<i64>> = vec![None; full.len()];
    let mut last = None;
    for (at, &is_full) in (0..).zip(full) {
        last = if is_full { Some(at) } else { last };
        nearest[at as usize] = last;
    }
    let mut next: Option<i64> = None;
    for (place, nearest) in nearest.iter_mut().enumerate().rev() {
        let at = place as i64;
        next = if full[place] { Some(at) } else { next };
        let nearer = |next: i64| nearest.is_none_or(|before| next - at < at - before);
        if next.is_some_and(nearer) {
            *nearest = next;
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal to a search through all full slots, for triangles, strips and scattered slots.
    #[test]
    fn the_nearest_slots_are_those_of_a_full_search() {
        let scattered = |at: usize| (at * 2_654_435_761) >> 7 & 31 == 0;
        for (width, height) in [(1, 1), (1, 9), (16, 1), (8, 8), (32, 16), (5, 40)] {
            let triangle = |at: usize| at % width * height > at / width * width;
            let row = |at: usize| at / width == height / 2;
            for shape in [&scattered as &dyn Fn(usize) -> bool, &triangle, &row] {
                let full: Vec<bool> = (0..width * height).map(shape).collect();
                let searched = (0..full.len()).map(|at| {
                    let away = |&other: &usize| {
                        let columns = (at % width).abs_diff(other % width);
                        columns.pow(2) + (at / width).abs_diff(other / width).pow(2)
                    };
                    (0..full.len()).filter(|&other| full[other]).min_by_key(away)
                });
                let searched: Option<Vec<usize>> = searched.collect();
                let found = nearest_full(&full, width);
                let found = found.map(|found| found.iter().map(|&at| at as usize).collect());
                assert_eq!(found, searched, "{width} x {height}");
            }
        }
    }
}
