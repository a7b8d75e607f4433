//! Numbers in titles.

use crate::failure::Typed;

/// At most seven digits, and no zeros behind: 1.079036, 1.2, 1e-9.
pub(crate) fn seven_digits(value: f64) -> String {
    let rounded = format!("{value:.6e}").parse().unwrap_or(value);
    Typed(rounded).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_say_nothing_are_left_out() {
        let cases = [
            (1.079_036_174_947, "1.079036"),
            (1.2, "1.2"),
            (4.0, "4"),
            (166.217_782_268_7, "166.2178"),
            (1e-9, "1e-9"),
            (1.23e-5, "0.0000123"),
            (-0.5, "-0.5"),
        ];
        for (value, text) in cases {
            assert_eq!(seven_digits(value), text);
        }
    }
}
