//! Number formats of titles, legends and ticks.

/// At most seven digits, no trailing zeros, a power of ten if that is shorter: 1.079036, 1.2, 1×10^{-9}.
pub(crate) fn seven_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    let (digits, exponent) = (rounded.to_string(), format!("{rounded:e}"));
    let text = match exponent.split_once('e') {
        Some((mantissa, power)) if digits.len() > exponent.len() + 2 => {
            format!("{mantissa}×10^{{{power}}}")
        }
        _ => digits,
    };
    text.replace('-', "−")
}

/// At most four decimals, no trailing zeros; smaller numbers by their leading digits.
pub(crate) fn short(value: f64) -> String {
    if value.abs() > 1e-12 && value.abs() < 5e-4 || value.abs() >= 1e7 {
        return seven_digits(format!("{value:.2e}").parse().unwrap_or(value));
    }
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

/// A value with its error, which has two digits, such as 1.88 ± 0.02.
pub(crate) fn plus_minus(value: f64, error: f64) -> String {
    let places = (1.0 - error.log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{value:.places$} ± {error:.places$}").replace('-', "−")
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
            (1e-9, "1×10^{−9}"),
            (1.23e-5, "0.0000123"),
            (-0.5, "−0.5"),
        ];
        for (value, text) in cases {
            assert_eq!(seven_digits(value), text);
        }
    }

    #[test]
    fn values_in_legends_are_short() {
        let cases = [(457.0, "457"), (-1.250_04, "−1.25"), (-1e-13, "0"), (1e-9, "1×10^{−9}")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
    }
}
