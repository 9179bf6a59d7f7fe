//! Lines of a plot as the strokes that are drawn: dashes, and turns where several lines coincide.

/// A place in a drawing, drawing units.
pub type Spot = (i32, i32);

/// A line's turn in a segment that several lines share: each draws every `of`-th dash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    pub rank: usize,
    pub of: usize,
}

pub const ALONE: Turn = Turn { rank: 0, of: 1 };

/// The turn of each segment of each line. Segments are shared if their ends are at most `near` apart.
pub fn turns(lines: &[Vec<Spot>], near: i32) -> Vec<Vec<Turn>> {
    let mut segments: Vec<([Spot; 2], usize, usize)> = Vec::new();
    for (line, spots) in lines.iter().enumerate() {
        let pairs = spots.windows(2).enumerate();
        segments.extend(pairs.map(|(i, pair)| ([pair[0], pair[1]], line, i)));
    }
    segments.sort_unstable();
    let mut turns: Vec<Vec<Turn>> =
        lines.iter().map(|spots| vec![ALONE; spots.len().saturating_sub(1)]).collect();
    let mut taken = vec![false; segments.len()];
    for first in 0..segments.len() {
        if taken[first] {
            continue;
        }
        let (ends, ..) = segments[first];
        let close = |a: Spot, b: Spot| (a.0 - b.0).abs().max((a.1 - b.1).abs()) <= near;
        let reach =
            segments[first..].iter().take_while(|(other, ..)| other[0].0 - ends[0].0 <= near);
        let mut shared: Vec<usize> = Vec::new();
        for (i, (other, line, _)) in (first..).zip(reach) {
            let new = !shared.iter().any(|&known: &usize| segments[known].1 == *line);
            if new && !taken[i] && close(other[0], ends[0]) && close(other[1], ends[1]) {
                shared.push(i);
            }
        }
        shared.iter().for_each(|&i| taken[i] = true);
        shared.sort_by_key(|&i| segments[i].1);
        let of = shared.len();
        for (rank, &i) in shared.iter().enumerate() {
            let (_, line, segment) = segments[i];
            turns[line][segment] = Turn { rank, of };
        }
    }
    turns
}

/// The strokes of a line: dashes of this pattern where it is alone, or all of it without a pattern; its turns, each
/// of length `turn`, where it is not.
pub fn strokes(line: &[Spot], turns: &[Turn], pattern: &[f64], turn: f64) -> Vec<Vec<Spot>> {
    let mut strokes = Vec::new();
    let mut begin = 0;
    while begin < turns.len() {
        let alone = turns[begin..].iter().take_while(|turn| turn.of == 1).count();
        if alone > 0 {
            strokes.extend(dashed(&line[begin..=begin + alone], pattern, 0.0));
        } else {
            let (Turn { rank, of }, segment) = (turns[begin], &line[begin..begin + 2]);
            // Every line has one turn at least.
            let length = turn.min(distance(segment[0], segment[1]) / of as f64);
            let pattern = [length, length * (of - 1) as f64];
            strokes.extend(dashed(segment, &pattern, length * (of - rank) as f64));
        }
        begin += alone.max(1);
    }
    strokes
}

/// The parts of a line that a pattern of lengths, drawn and left out in turn, leaves; `phase` is where in the pattern
/// the line begins.
fn dashed(line: &[Spot], pattern: &[f64], phase: f64) -> Vec<Vec<Spot>> {
    let period: f64 = pattern.iter().sum();
    if period <= 0.0 {
        return vec![line.to_vec()];
    }
    let (mut item, mut left) = (0, phase % period);
    while left >= pattern[item] {
        left -= pattern[item];
        item = (item + 1) % pattern.len();
    }
    left = pattern[item] - left;
    let mut strokes: Vec<Vec<Spot>> = Vec::new();
    let mut stroke: Vec<Spot> = line.first().copied().into_iter().collect();
    for pair in line.windows(2) {
        let length = distance(pair[0], pair[1]);
        let at = |way: f64| {
            let along = |a: i32, b: i32| a + (f64::from(b - a) * way / length).round() as i32;
            (along(pair[0].0, pair[1].0), along(pair[0].1, pair[1].1))
        };
        let mut way = 0.0;
        while length - way > left {
            way += left;
            stroke.push(at(way));
            if item % 2 == 0 {
                strokes.push(std::mem::take(&mut stroke));
            }
            stroke = vec![at(way)];
            item = (item + 1) % pattern.len();
            left = pattern[item];
        }
        left -= length - way;
        stroke.push(pair[1]);
    }
    if item % 2 == 0 {
        strokes.push(stroke);
    }
    strokes.retain(|stroke| stroke.windows(2).any(|pair| pair[0] != pair[1]));
    strokes
}

fn distance(a: Spot, b: Spot) -> f64 {
    f64::from(a.0 - b.0).hypot(f64::from(a.1 - b.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(strokes: &[Vec<Spot>]) -> f64 {
        strokes.iter().flat_map(|s| s.windows(2)).map(|pair| distance(pair[0], pair[1])).sum()
    }

    #[test]
    fn a_pattern_leaves_its_share_also_around_corners() {
        let line = [(0, 0), (50, 0), (50, 55)];
        let dashes = dashed(&line, &[10.0, 5.0], 0.0);
        assert_eq!(dashes.len(), 7);
        assert_eq!(dashes[3], [(45, 0), (50, 0), (50, 5)]);
        assert_eq!(length(&dashes), 70.0);
        assert_eq!(dashed(&line, &[], 0.0), [line.to_vec()]);
        assert_eq!(dashed(&line[..1], &[1.0, 1.0], 0.0), [[(0, 0); 0]; 0]);
    }

    /// However many lines coincide, together they draw the whole segment, none over another.
    #[test]
    fn coinciding_lines_take_turns() {
        for lines in 2..=24 {
            let line = vec![(0, 0), (600, 0), (1200, 0)];
            let all = vec![line.clone(); lines];
            let turns = turns(&all, 0);
            let mut drawn: Vec<Vec<Spot>> = Vec::new();
            for (i, turns) in turns.iter().enumerate() {
                assert_eq!(turns, &[Turn { rank: i, of: lines }; 2]);
                let strokes = strokes(&line, turns, &[], 10.0);
                assert!(length(&strokes) > 0.0, "line {i} of {lines} is hidden");
                drawn.extend(strokes);
            }
            drawn.sort_unstable();
            assert!(drawn.windows(2).all(|pair| pair[0].last() <= pair[1].first()), "{drawn:?}");
            assert_eq!(length(&drawn), 1200.0);
        }
    }

    #[test]
    fn only_what_coincides_is_shared() {
        let lines = [vec![(0, 0), (10, 0), (20, 9)], vec![(0, 1), (10, 0), (20, 5)], vec![(3, 3)]];
        let turns = turns(&lines, 2);
        let (first, second) = (Turn { rank: 0, of: 2 }, Turn { rank: 1, of: 2 });
        assert_eq!(turns, [vec![first, ALONE], vec![second, ALONE], vec![]]);
    }

    /// A segment shorter than the turns of its lines shows all of them.
    #[test]
    fn short_segments_show_all_lines() {
        let line = vec![(0, 0), (48, 0)];
        for (rank, turns) in turns(&vec![line.clone(); 4], 0).iter().enumerate() {
            let expected = vec![(12 * rank as i32, 0), (12 * (rank as i32 + 1), 0)];
            assert_eq!(strokes(&line, turns, &[], 80.0), [expected]);
        }
    }
}
