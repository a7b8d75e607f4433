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
        let values = || functions.iter().copied().flatten();
        let largest = values().fold(0.0, |m: f64, v| m.max(v.abs()));
        let (mut decimals, mut digits) = (0, 0);
        for value in values() {
            let (leading, of_value) = digits_of(*value);
            digits = digits.max(of_value);
            decimals = decimals.max(of_value - 1 - leading);
        }
        let unit = |value: f64| 10_f64.powi((-decimals).max(digits_of(value).0 + 1 - digits));
        let least = REPRODUCED * largest;
        let is_rounding = (least..=ROUNDED * largest).contains(&unit(largest));
        let of_row = |i: usize| {
            let size = functions.iter().fold(0.0, |m: f64, f| m.max(f[i].abs()));
            if is_rounding { unit(size).max(least) } else { least }
        };
        Self { rows: (0..functions[0].len()).map(of_row).collect(), is_rounding }
    }
}

/// Power of ten of the first digit of a value, and its number of digits, of at most fourteen: what a product of a rounded
/// number is off by does not count.
fn digits_of(value: f64) -> (i32, i32) {
    let text = format!("{:.13e}", value.abs());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = mantissa.trim_end_matches('0').bytes().filter(u8::is_ascii_digit).count();
    (exponent.parse().unwrap_or(0), i32::try_from(digits).unwrap_or(0))
}
