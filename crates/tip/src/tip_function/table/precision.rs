//! The precision to which the rows of a table are known.

/// Largest error with which a coarser lattice reproduces rows without rounding, as a fraction of the largest value: a
/// few times the saturation error.
const REPRODUCED: f64 = 4e-12;
/// Largest unit of the last digit, as a fraction of the largest value, at which values count as rounded to that digit.
const ROUNDED: f64 = 2e-4;

/// To what precision rows are known.
pub(super) struct Precision {
    /// Of each row: the unit of the last digit, if the values are rounded, and never less than what a lattice can
    /// reproduce.
    pub(super) rows: Vec<f64>,
    pub(super) is_rounding: bool,
}

impl Precision {
    /// The precision common to several functions, rounded to as many decimals or digits as the value that has most.
    pub(super) fn of(functions: &[&[f64]]) -> Self {
        let values = || functions.iter().copied().flatten().map(|value| value.abs());
        let largest = values().fold(0.0, f64::max);
        let (mut decimals, mut digits) = (0, 0);
        for value in values().filter(|value| *value > 0.0) {
            let (leading, of_value) = digits_of(value);
            digits = digits.max(of_value);
            decimals = decimals.max(of_value - 1 - leading);
        }
        let unit = |value: f64| {
            let of_digits = (value > 0.0).then(|| digits_of(value).0 + 1 - digits);
            10_f64.powi(of_digits.unwrap_or(-decimals).max(-decimals))
        };
        let least = REPRODUCED * largest;
        let is_rounding = (least..=ROUNDED * largest).contains(&unit(largest));
        let of_row = |i: usize| {
            let size = functions.iter().fold(0.0, |m: f64, f| m.max(f[i].abs()));
            if is_rounding { unit(size).max(least) } else { least }
        };
        Self { rows: (0..functions[0].len()).map(of_row).collect(), is_rounding }
    }
}

/// Power of ten of the first digit of a value > 0, and its number of digits, of at most fourteen: what a product of a
/// rounded number is off by does not count.
fn digits_of(value: f64) -> (i32, i32) {
    let text = format!("{value:.13e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = mantissa.trim_end_matches('0').bytes().filter(u8::is_ascii_digit).count();
    (exponent.parse().unwrap_or(0), i32::try_from(digits).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_precision_is_the_unit_of_the_last_digit() {
        let of = |f: &[f64]| Precision::of(&[f]).rows;
        let near = |found: Vec<f64>, wanted: &[f64]| {
            let off = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() > 1e-9;
            assert!(!found.iter().zip(wanted).any(off), "{found:?} {wanted:?}");
        };
        // Six decimals, also of a third of such numbers times three. They could be six digits.
        near(of(&[1.0, 0.606531, 0.0003, 0.0]), &[1e-5, 1e-6, 1e-6, 1e-6]);
        near(of(&[1.234567, 0.606531 / 3.0 * 3.0, 0.0003, 0.0]), &[1e-6; 4]);
        // Five digits, and a zero that has none.
        near(of(&[2.7183e-3, 1.35e-4, 1.2341e-9, 0.0]), &[1e-7, 1e-8, 1e-13, 1e-13]);
        // All digits, or too few.
        let exact = 1.0 / 3.0;
        near(of(&[exact, 0.2]), &[4e-12 * exact; 2]);
        near(of(&[0.9, 0.25, 0.125]), &[4e-12 * 0.9; 3]);
    }
}
