//! The range of an axis, linear or logarithmic, and its ticks.

use crate::ticks::{self, Tick};
use stickslip::ScaleName;

/// Smallest span, relative to the scale, that is drawn; smaller ones count as round-off of a constant.
const ROUND_OFF: f64 = 1e-6;
/// Largest absolute value that is drawn.
const HUGE: f64 = 1e100;
/// Smallest span relative to the larger end; numbers closer to 0 than this count as 0.
const LEAST_PART: f64 = 1e-12;
const TINY: f64 = 1.0 / HUGE;
/// Largest number of decades of a logarithmic axis, counted from its highest value.
const DECADES: f64 = 60.0;

/// An axis from `low` to `high`, both drawable, and above 0 if it is logarithmic.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) scale: ScaleName,
    /// Ticks with and without labels.
    pub(crate) ticks: Vec<Tick>,
}

/// Parameters for fitting an axis to values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fit {
    pub(crate) scale: ScaleName,
    /// Fraction of the span left free at either end.
    pub(crate) padding: f64,
    /// Typical size of the quantity, 0 if unknown. A variation far below it is round-off.
    pub(crate) natural: f64,
    /// Approximate number of ticks.
    pub(crate) ticks: f64,
}

impl Axis {
    /// An axis from `low` to `high`, if these form a range, with about `count` ticks.
    pub(crate) fn new(low: f64, high: f64, scale: ScaleName, count: f64) -> Self {
        match scale {
            ScaleName::Logarithmic => {
                let high = if (TINY..HUGE).contains(&high) { high } else { 1.0 };
                let low = if (TINY..HUGE).contains(&low) { low } else { 1e-3 * high };
                let high = if high > low * (1.0 + 1e-9) { high } else { 10.0 * low };
                Self { low, high, scale, ticks: ticks::logarithmic(low, high, count) }
            }
            ScaleName::Linear => {
                let (low, high) = if can_be_drawn([low, high]) { (low, high) } else { about(low) };
                Self { low, high, scale, ticks: ticks::linear(low, high, count) }
            }
        }
    }

    /// An axis fitted to the drawable ones of `values`. A constant is centred in a range a quarter of its size, so
    /// that its round-off is not magnified.
    pub(crate) fn fit(values: impl IntoIterator<Item = f64>, fit: Fit) -> Self {
        let logarithmic = fit.scale == ScaleName::Logarithmic;
        let shown = values.into_iter().filter(|v| drawable(*v) && (!logarithmic || *v > 0.0));
        let Some((low, high)) = extremes(shown) else {
            let low = if logarithmic { 0.1 } else { 0.0 };
            return Self::new(low, 1.0, fit.scale, fit.ticks);
        };
        let (low, high) = if logarithmic {
            logarithmic_range(low, high, fit.padding)
        } else {
            linear_range(low, high, fit)
        };
        Self::new(low, high, fit.scale, fit.ticks)
    }

    /// Relative position of a value: 0 at `low`, 1 at `high`; `None` for a value that cannot be placed on this axis.
    pub(crate) fn part(&self, value: f64) -> Option<f64> {
        let part = match self.scale {
            ScaleName::Linear => (value - self.low) / (self.high - self.low),
            ScaleName::Logarithmic if value > 0.0 => {
                (value / self.low).ln() / (self.high / self.low).ln()
            }
            ScaleName::Logarithmic => return None,
        };
        drawable(value).then_some(part)
    }

    /// The ticks that have a label.
    pub(crate) fn labelled(&self) -> impl Iterator<Item = (f64, &str)> {
        self.ticks.iter().filter_map(|tick| Some((tick.value, tick.label.as_deref()?)))
    }
}

/// Whether two numbers are the ends of a valid axis: below 1e100, and apart by at least 1e-12 of the larger and by
/// 1e-100, for doubles to resolve values between them.
pub fn can_be_drawn([low, high]: [f64; 2]) -> bool {
    let size = low.abs().max(high.abs());
    drawable(low) && drawable(high) && high - low >= (LEAST_PART * size).max(TINY)
}

/// Ends of an axis for a single value.
fn about(value: f64) -> (f64, f64) {
    let value = if drawable(value) { value } else { 0.0 };
    (value, value + value.abs().max(1.0))
}

fn linear_range(low: f64, high: f64, fit: Fit) -> (f64, f64) {
    let scale = low.abs().max(high.abs()).max(fit.natural);
    if high - low > ROUND_OFF * scale && scale > 1.0 / HUGE {
        let pad = fit.padding * (high - low);
        return (low - pad, high + pad);
    }
    let middle = 0.5 * (low + high);
    let half = if scale > 1.0 / HUGE { 0.12 * scale } else { 1.0 };
    (middle - half, middle + half)
}

fn logarithmic_range(low: f64, high: f64, padding: f64) -> (f64, f64) {
    // Numbers next to 0 have no place on an axis whose other end is as large as may be.
    let (low, high) = (low.max(TINY), high.max(TINY));
    let (low, high) = (low.log10().max(high.log10() - DECADES), high.log10());
    let pad = if high - low > ROUND_OFF { padding * (high - low) } else { 0.5 };
    (10f64.powf(low - pad), 10f64.powf(high + pad))
}

/// Whether a number can be placed on an axis: finite, with finite spans and powers.
pub(crate) fn drawable(value: f64) -> bool {
    value.abs() < HUGE
}

/// Smallest and largest value.
pub(crate) fn extremes(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().fold(None, |range, v| match range {
        None => Some((v, v)),
        Some((low, high)) => Some((v.min(low), v.max(high))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIT: Fit = Fit { scale: ScaleName::Linear, padding: 0.05, natural: 1.0, ticks: 5.0 };

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.labelled().map(|(_, label)| label).collect()
    }

    #[test]
    fn round_off_of_a_constant_is_not_magnified() {
        let axis = Axis::fit([1.07 - 1e-12, 1.07 + 1e-12], FIT);
        assert!(axis.high - axis.low > 0.2);
        assert_eq!(labels(&axis), ["0.95", "1.00", "1.05", "1.10", "1.15"]);
    }

    #[test]
    fn nothing_to_fit_gives_a_unit_axis() {
        let nothing = [f64::NAN, f64::INFINITY];
        assert_eq!(labels(&Axis::fit(nothing, FIT)).first(), Some(&"0.0"));
        let axis = Axis::fit([-1.0, 0.0], Fit { scale: ScaleName::Logarithmic, ..FIT });
        assert!(axis.low > 0.0 && axis.high > axis.low);
    }

    #[test]
    fn ends_that_no_axis_goes_between_are_put_apart() {
        let nearly = f64::from_bits(1.0_f64.to_bits() + 3);
        for (low, high) in [
            (0.0, 1e-310),
            (0.0, 5e-324),
            (-1e-320, 1e-320),
            (1.0, nearly),
            (1e90, 1e90 * nearly),
            (-1e300, 1e300),
            (f64::NAN, 1.0),
            (2.0, 1.0),
        ] {
            for scale in [ScaleName::Linear, ScaleName::Logarithmic] {
                let axis = Axis::new(low, high, scale, 5.0);
                assert!(can_be_drawn([axis.low, axis.high]), "{low} {high} {axis:?}");
                let count = axis.labelled().count();
                assert!((1..200).contains(&count), "{low} {high} {axis:?}");
            }
        }
        assert!(
            can_be_drawn([0.0, 1e-99])
                && can_be_drawn([1.0, 1.0 + 1e-11])
                && !can_be_drawn([1.0, 1.0])
        );
    }

    #[test]
    fn equal_ratios_are_equally_far_apart_on_a_logarithmic_axis() {
        let axis = Axis::new(1e-3, 1e3, ScaleName::Logarithmic, 6.0);
        for (value, part) in [(1e-3, 0.0), (1.0, 0.5), (10.0, 4.0 / 6.0), (1e3, 1.0)] {
            assert!((axis.part(value).unwrap() - part).abs() < 1e-12);
        }
        assert_eq!((axis.part(0.0), axis.part(-1.0)), (None, None));
    }
}
