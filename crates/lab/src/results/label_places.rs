//! Places of labels in a column: as near as possible to what they name, and apart.

/// Middles of labels of this height, whose wanted middles rise, between `low` and `high`. The sum of squares of what
/// they are moved by is the least; if there is too little room, the last ones are beyond `high`.
pub fn places(wanted: &[i32], height: i32, low: i32, high: i32) -> Vec<i32> {
    // Without their heights they need only rise: neighbours that do not are pooled at their mean.
    let mut pools: Vec<(i64, i64)> = Vec::new();
    for (rank, &middle) in (0..).zip(wanted) {
        let mut pool = (i64::from(middle - rank * height), 1);
        while let Some(last) = pools.pop_if(|last| last.0 * pool.1 >= pool.0 * last.1) {
            pool = (pool.0 + last.0, pool.1 + last.1);
        }
        pools.push(pool);
    }
    let top = high - height * wanted.len().saturating_sub(1) as i32;
    let means = pools.iter().flat_map(|&(sum, labels)| {
        std::iter::repeat_n(sum.div_euclid(labels) as i32, labels as usize)
    });
    (0..).zip(means).map(|(rank, mean)| mean.min(top).max(low) + rank * height).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_stay_where_there_is_room() {
        assert_eq!(places(&[10, 40, 90], 20, 0, 100), [10, 40, 90]);
        assert_eq!(places(&[], 20, 0, 100), [0; 0]);
    }

    #[test]
    fn labels_of_one_place_stand_around_it() {
        assert_eq!(places(&[50, 50, 50], 20, 0, 100), [30, 50, 70]);
        assert_eq!(places(&[0, 0], 20, 0, 100), [0, 20]);
        assert_eq!(places(&[99, 100], 20, 0, 100), [80, 100]);
    }

    #[test]
    fn labels_are_apart_and_in_order_however_they_are_wanted() {
        let mut seed = 1_u64;
        let mut random = |below: u64| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        for _ in 0..500 {
            let labels = random(24) + 1;
            let mut wanted: Vec<i32> = (0..labels).map(|_| random(400) as i32).collect();
            wanted.sort_unstable();
            let places = places(&wanted, 17, 0, 400);
            assert!(places.windows(2).all(|pair| pair[1] - pair[0] >= 17), "{wanted:?} {places:?}");
            assert!(places.iter().all(|place| (0..=400).contains(place)), "{wanted:?} {places:?}");
        }
    }
}
