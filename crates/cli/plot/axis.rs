//! The range of an axis, its ticks and their labels.

/// Spans below this part of the scale are taken for round-off of a constant.
const ROUND_OFF: f64 = 1e-6;
/// Numbers from here on are written as a power of ten.
const LARGE: f64 = 1e6;
/// Tick distances below are written as a power of ten.
const SMALL: f64 = 1e-6;

/// Bound of the numbers that are drawn.
const HUGE: f64 = 1e100;

/// A linear axis.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Distance of the ticks, which lie at its multiples.
    pub(super) step: f64,
}

/// How an axis is fitted to values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// Part of the span left free at either end.
    pub(super) padding: f64,
    /// Size that the quantity has by nature, 0 when unknown. A variation far below it is round-off.
    pub(super) natural: f64,
    /// About how many ticks.
    pub(super) ticks: f64,
}

impl Axis {
    /// From `low` to `high`, or to one above `low` unless that is less, with about `ticks` ticks.
    pub(super) fn new(low: f64, high: f64, ticks: f64) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Self { low, high, step: nice_step((high - low) / ticks) }
    }

    /// Fitted to the drawable ones of `values`. A constant is put in the middle of a range a
    /// quarter of its size wide, rather than its round-off magnified.
    pub(super) fn fit(values: impl IntoIterator<Item = f64>, fit: Fit) -> Self {
        let Some((low, high)) = extremes(values) else {
            return Self::new(0.0, 1.0, fit.ticks);
        };
        let scale = low.abs().max(high.abs()).max(fit.natural);
        if high - low > ROUND_OFF * scale && scale > 1.0 / HUGE {
            let pad = fit.padding * (high - low);
            return Self::new(low - pad, high + pad, fit.ticks);
        }
        let middle = 0.5 * (low + high);
        let half = if scale > 1.0 / HUGE { 0.12 * scale } else { 1.0 };
        Self::new(middle - half, middle + half, fit.ticks)
    }

    /// The label of the tick at `value`.
    pub(super) fn label(&self, value: f64) -> String {
        let largest = self.low.abs().max(self.high.abs());
        let value = if value.abs() < 1e-6 * self.step { 0.0 } else { value };
        let finest = exponent(self.step);
        let text = if largest >= LARGE || self.step < SMALL {
            let power = exponent(largest);
            scientific(value, power, digits(power - finest))
        } else {
            format!("{value:.*}", digits(-finest))
        };
        text.replace('-', "−")
    }

    /// The labels of all ticks.
    pub(super) fn labels(&self) -> Vec<String> {
        self.ticks().into_iter().map(|(_, label)| label).collect()
    }

    /// All ticks with their labels.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let (first, last) = ((self.low / self.step).ceil(), (self.high / self.step).floor());
        let count = (last - first).clamp(0.0, 100.0) as usize;
        let tick = |i: usize| (first + i as f64) * self.step;
        (0..=count).map(|i| (tick(i), self.label(tick(i)))).collect()
    }
}

/// Whether a number can be put on an axis: finite, and so far from overflow that spans and powers
/// are.
pub(super) fn drawable(value: f64) -> bool {
    value.abs() < HUGE
}

/// Smallest and largest of the drawable values.
fn extremes(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().filter(|v| drawable(*v)).fold(None, |range, v| match range {
        None => Some((v, v)),
        Some((low, high)) => Some((v.min(low), v.max(high))),
    })
}

/// 1, 2 or 5 times a power of ten, near `rough` or a little above.
fn nice_step(rough: f64) -> f64 {
    let power = 10f64.powi(exponent(rough));
    let factor = match rough / power {
        f if f < 1.4 => 1.0,
        f if f < 2.8 => 2.0,
        f if f < 7.0 => 5.0,
        _ => 10.0,
    };
    factor * power
}

/// Decimal exponent of the leading digit; the margin keeps 1e-3 from being taken for 9.99e-4.
fn exponent(value: f64) -> i32 {
    (value.abs().log10() + 1e-9).floor() as i32
}

fn digits(count: i32) -> usize {
    usize::try_from(count).unwrap_or(0)
}

/// Such as 1.5×10⁻⁷.
fn scientific(value: f64, power: i32, digits: usize) -> String {
    let mantissa = value / 10f64.powi(power);
    if mantissa.abs() < 1e-12 {
        return "0".to_owned();
    }
    format!("{mantissa:.digits$}×10{}", superscript(power))
}

fn superscript(number: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    };
    number.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIT: Fit = Fit { padding: 0.05, natural: 1.0, ticks: 5.0 };

    #[test]
    fn round_off_of_a_constant_is_not_magnified() {
        let axis = Axis::fit([1.07 - 1e-12, 1.07 + 1e-12], FIT);
        assert!(axis.high - axis.low > 0.2);
        assert_eq!(axis.labels(), ["0.95", "1.00", "1.05", "1.10", "1.15"]);
    }

    #[test]
    fn tick_labels_carry_the_digits_of_the_step() {
        assert_eq!(Axis::new(0.0, 0.5, 5.0).labels(), ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(Axis::new(-40.0, 40.0, 4.0).labels(), ["−40", "−20", "0", "20", "40"]);
        assert_eq!(Axis::new(0.0, 2e-9, 2.0).labels(), ["0", "1×10⁻⁹", "2×10⁻⁹"]);
    }

    #[test]
    fn nothing_to_fit_gives_a_unit_axis() {
        let axis = Axis::fit([f64::NAN, f64::INFINITY], FIT);
        assert_eq!(axis.labels().first().map(String::as_str), Some("0.0"));
    }
}
