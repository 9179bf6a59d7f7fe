//! Pareto front: points for which no other point is lower in both coordinates.

/// The Pareto front of points with rising x: each has a lower y than all before it.
pub fn front(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut least = f64::INFINITY;
    let mut front: Vec<(f64, f64)> = Vec::new();
    for &(x, y) in points.iter().filter(|(_, y)| y.is_finite()) {
        if y < least {
            // Of points at the same x only the lowest counts.
            front.pop_if(|last| last.0 == x);
            front.push((x, y));
            least = y;
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_on_the_front_is_bettered() {
        let points = [(1.0, 5.0), (2.0, 6.0), (2.0, 4.0), (3.0, 4.0), (4.0, 1.0), (4.0, 0.5)];
        assert_eq!(front(&points), [(1.0, 5.0), (2.0, 4.0), (4.0, 0.5)]);
        assert!(front(&[]).is_empty());
    }
}
