//! Names and numbers that messages show: short ones, however long the input is.

/// The longest name that is shown whole, characters.
const LONGEST: usize = 256;

/// How much is shown of a longer one: its start and its end.
const SHOWN: [usize; 2] = [160, 64];

/// Numbers from here on are shown with an exponent.
const LARGE: f64 = 1e7;

/// A message with its long names shortened: what is in quotes, and words.
pub fn shortened(message: &str) -> String {
    let unquoted = |part: &str| part.split_inclusive(char::is_whitespace).map(short_name).collect();
    let parts = message.split('"').enumerate();
    let parts = parts.map(|(i, part)| if i % 2 == 1 { short_name(part) } else { unquoted(part) });
    parts.collect::<Vec<String>>().join("\"")
}

/// A name; of a long one, its start and its end.
pub fn short_name(text: &str) -> String {
    let count = text.chars().count();
    if count <= LONGEST {
        return text.to_owned();
    }
    let [start, end] = SHOWN;
    let first: String = text.chars().take(start).collect();
    let last: String = text.chars().skip(count - end).collect();
    format!("{first}…{last}")
}

/// A number with this number of decimals, or with an exponent if it is large, or less than the last decimal
/// can show.
pub fn decimal(number: f64, decimals: usize) -> String {
    let size = number.abs();
    let small = 0.0 < size && size * 10_f64.powi(decimals as i32) < 1.0;
    if small || (size >= LARGE && number.is_finite()) {
        format!("{number:.decimals$e}")
    } else {
        format!("{number:.decimals$}")
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn long_names_are_shortened_and_the_rest_stays() {
        let (long, spaced) = ("x".repeat(200_000), "chair leg ".repeat(20_000));
        for name in [&long, &spaced] {
            let text = shortened(&format!("a.obj:3: material \"{name}\": expected \"it\" less"));
            assert!(text.starts_with(&format!("a.obj:3: material \"{}…", &name[..160])), "{text}");
            assert!(
                text.ends_with(&format!("{}\": expected \"it\" less", &name[name.len() - 64..]))
            );
        }
        let text = shortened(&format!("a.json: {long}: expected a number"));
        assert!(text.starts_with("a.json: xxx") && text.ends_with("xxx: expected a number"));
        assert!(text.chars().count() < 300);
    }

    #[test]
    fn large_numbers_have_an_exponent() {
        assert_eq!(decimal(1e300, 4), "1.0000e300");
        assert_eq!(decimal(-1e7, 1), "-1.0e7");
        assert_eq!(decimal(9_999_999.0, 2), "9999999.00");
        assert_eq!(decimal(0.25, 4), "0.2500");
    }

    #[test]
    fn small_numbers_have_an_exponent() {
        assert_eq!(decimal(1e-30, 4), "1.0000e-30");
        assert_eq!(decimal(-4e-6, 2), "-4.00e-6");
        assert_eq!(decimal(0.05, 1), "5.0e-2");
        assert_eq!(decimal(0.0, 2), "0.00");
        for (decimals, text) in [(1, "0.1"), (2, "0.01"), (3, "0.001"), (4, "0.0001")] {
            assert_eq!(decimal(text.parse().unwrap(), decimals), text);
        }
    }

    proptest! {
        /// At least the first digit is right.
        #[test]
        fn what_is_shown_is_near_the_number(number in proptest::num::f64::NORMAL, decimals in 1_usize..5) {
            let shown: f64 = decimal(number, decimals).parse().unwrap();
            prop_assert!((shown - number).abs() <= 0.5 * number.abs(), "{number} {shown}");
        }

        /// Messages without long names are left as they are.
        #[test]
        fn short_messages_stay(message in "\\PC{0,256}") {
            prop_assert_eq!(shortened(&message), message);
        }

        #[test]
        fn no_number_is_long(number in proptest::num::f64::ANY) {
            prop_assert!(decimal(number, 4).len() <= 16, "{}", decimal(number, 4));
        }
    }
}
