//! A number as the paper prints it.

use stickslip::NumberDocument;

/// A printed number: its place in the paper, and its quantity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Printed<'a> {
    pub(super) quantity: &'a str,
    pub(super) case: &'a str,
    pub(super) place: &'a str,
    /// The number as printed, a decimal as precise as its digits, a whole number or a fraction.
    pub(super) text: &'a str,
}

/// A number printed as `text` at this place of the paper.
pub(super) fn number<'a>(
    quantity: &'a str,
    case: &'a str,
    place: &'a str,
    text: &'a str,
) -> Printed<'a> {
    Printed { quantity, case, place, text }
}

impl Printed<'_> {
    /// The comparison with our value.
    pub(super) fn beside(&self, ours: f64) -> NumberDocument {
        let (value, precision) = (value(self.text), precision(self.text));
        // The quotient of two decimals is off by a rounding.
        let agrees = (ours - value).abs() <= precision * (1.0 + 1e-9);
        NumberDocument {
            quantity: self.quantity.into(),
            case: self.case.into(),
            place: self.place.into(),
            printed: self.text.into(),
            value,
            precision,
            ours,
            relative_difference: (value.abs() > 0.0).then(|| ours / value - 1.0),
            agrees,
            correction: None,
            remark: None,
        }
    }

    /// The comparison with our value, which differs for the reason given by an entry of docs/findings/corrections.md.
    pub(super) fn corrected(&self, ours: f64, correction: u32, remark: &str) -> NumberDocument {
        let remark = Some(remark.into());
        NumberDocument { correction: Some(correction), remark, ..self.beside(ours) }
    }
}

/// The value of a decimal, a whole number or a fraction.
fn value(text: &str) -> f64 {
    let number = |text: &str| text.parse().unwrap_or(f64::NAN);
    match text.split_once('/') {
        Some((over, under)) => number(over) / number(under),
        None => number(text),
    }
}

/// Allowed difference of a whole number, which is exact.
const EXACT: f64 = 1e-9;
/// Allowed difference of a fraction: an exact exponent, which is measured at a finite distance from its limit.
const EXPONENT: f64 = 5e-3;

/// Allowed difference: half a unit of the last digit of a decimal, [`EXPONENT`] of a fraction, or [`EXACT`].
fn precision(text: &str) -> f64 {
    match text.split_once('.') {
        Some((_, decimals)) => {
            0.5 * 0.1_f64.powi(i32::try_from(decimals.len()).unwrap_or(i32::MAX))
        }
        None if text.contains('/') => EXPONENT,
        None => EXACT,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_printed_number_is_as_precise_as_its_digits() {
        let printed = |text| number("αc", "", "", text);
        assert!(printed("1.069").beside(1.0694).agrees);
        assert!(!printed("1.069").beside(1.0696).agrees);
        assert!(printed("0.96").beside(0.9649).agrees);
        assert!(!printed("0.960").beside(0.9649).agrees);
        assert!(printed("4").beside(4.0 + 1e-12).agrees && !printed("4").beside(4.01).agrees);
        assert!(printed("1/2").beside(0.499).agrees && !printed("1/2").beside(0.49).agrees);
        assert!(!printed("x").beside(1.0).agrees);
        assert_eq!(printed("0").beside(0.1).relative_difference, None);
    }
}
