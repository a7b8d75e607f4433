//! Ticks: multiples of 1, 2 or 5 on a linear axis, decades on a logarithmic one.

/// Smallest number written as a power of ten.
const LARGE: f64 = 1e6;
/// Tick distance below which numbers are written as powers of ten.
const SMALL: f64 = 9e-5;
/// Largest number of decades with minor ticks at 2 … 9.
const MOST_MINOR: i32 = 8;
/// A logarithmic axis with fewer decades than this has ticks at 1, 2 and 5; below the second limit, at equal
/// distances.
const FEW_DECADES: f64 = 1.7;
const NO_DECADE: f64 = 0.6;

/// Number of ticks to try on an axis that would otherwise have only one.
const MOST_TRIED: f64 = 20.0;

/// A tick, with a label unless it is a minor one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: Option<String>,
}

/// About `count` ticks at multiples of 1, 2 or 5 times a power of ten.
pub(crate) fn linear(low: f64, high: f64, count: f64) -> Vec<Tick> {
    let step = nice_step((high - low) / count);
    let largest = low.abs().max(high.abs());
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    if last - first < 1.0 && count < MOST_TRIED {
        // A single tick defines no scale.
        return linear(low, high, 1.7 * count);
    }
    let ticks = (last - first).clamp(0.0, 100.0) as usize;
    let tick = |i: usize| {
        let value = (first + i as f64) * step;
        Tick { value, label: Some(label(value, step, largest)) }
    };
    (0..=ticks).map(tick).collect()
}

/// About `count` labelled ticks, at decades if there are enough of them.
pub(crate) fn logarithmic(low: f64, high: f64, count: f64) -> Vec<Tick> {
    let span = (high / low).log10();
    if span < NO_DECADE {
        return linear(low, high, count);
    }
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let every = (span / (1.6 * count.max(2.0))).ceil().max(1.0) as i32;
    let minor = last - first <= MOST_MINOR.max(count as i32);
    let labelled = |power: i32, digit: i32| match digit {
        1 => power.rem_euclid(every) == 0,
        2 | 5 => span < FEW_DECADES,
        _ => false,
    };
    let plain = low >= 0.999e-3 && high <= 1.001e4;
    let tick = |(power, digit): (i32, i32)| {
        let value = f64::from(digit) * 10f64.powi(power);
        let label = labelled(power, digit).then(|| power_label(power, digit, plain));
        Tick { value, label }
    };
    let all = (first..=last).flat_map(|power| (1..10).map(move |digit| (power, digit)));
    all.filter(|(_, digit)| minor || *digit == 1)
        .map(tick)
        .filter(|tick| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(&tick.value))
        .collect()
}

/// A label such as 0.02, 10^{-6} or 5×10^{-6}.
fn power_label(power: i32, digit: i32, plain: bool) -> String {
    if plain {
        let decimals = usize::try_from(-power).unwrap_or(0);
        return format!("{:.decimals$}", f64::from(digit) * 10f64.powi(power));
    }
    let raised = format!("10^{{{power}}}");
    if digit == 1 { raised } else { format!("{digit}×{raised}") }
}

/// A label with as many digits as the tick distance.
fn label(value: f64, step: f64, largest: f64) -> String {
    let value = if value.abs() < 1e-6 * step { 0.0 } else { value };
    let finest = exponent(step);
    let text = if largest >= LARGE || step < SMALL {
        let power = exponent(largest);
        scientific(value, power, digits(power - finest))
    } else {
        format!("{value:.*}", digits(-finest))
    };
    text.replace('-', "−")
}

/// 1, 2 or 5 times a power of ten, close to `rough` or slightly above.
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

/// Decimal exponent of the leading digit; a margin protects 1e-3 from being read as 9.99e-4.
fn exponent(value: f64) -> i32 {
    (value.abs().log10() + 1e-9).floor() as i32
}

fn digits(count: i32) -> usize {
    usize::try_from(count).unwrap_or(0)
}

/// A label such as 1.5×10^{-7}.
fn scientific(value: f64, power: i32, digits: usize) -> String {
    let mantissa = value / 10f64.powi(power);
    if mantissa.abs() < 1e-12 {
        return "0".to_owned();
    }
    format!("{mantissa:.digits$}×10^{{{power}}}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|tick| tick.label.as_deref()).collect()
    }

    #[test]
    fn tick_labels_carry_the_digits_of_the_step() {
        let cases: [(f64, f64, f64, &[&str]); 3] = [
            (0.0, 0.5, 5.0, &["0.0", "0.1", "0.2", "0.3", "0.4", "0.5"]),
            (-40.0, 40.0, 4.0, &["−40", "−20", "0", "20", "40"]),
            (0.0, 2e-9, 2.0, &["0", "1×10^{−9}", "2×10^{−9}"]),
        ];
        for (low, high, count, expected) in cases {
            assert_eq!(labels(&linear(low, high, count)), expected);
        }
    }

    #[test]
    fn an_axis_has_two_ticks_at_least() {
        assert_eq!(labels(&linear(0.963, 1.037, 2.0)), ["0.98", "1.00", "1.02"]);
        assert!(labels(&linear(1.0 - 1e-4, 1.0 + 3e-4, 1.0)).len() > 1);
    }

    #[test]
    fn decades_are_labelled_and_have_small_ticks_between() {
        let ticks = logarithmic(1e-6, 1e-2, 5.0);
        assert_eq!(labels(&ticks), ["10^{-6}", "10^{-5}", "10^{-4}", "10^{-3}", "10^{-2}"]);
        assert_eq!(ticks.len(), 4 * 9 + 1);
        assert!((ticks[1].value - 2e-6).abs() < 1e-18 && ticks[1].label.is_none());
    }

    #[test]
    fn many_decades_are_labelled_in_equal_steps_and_few_at_2_and_5_too() {
        assert_eq!(
            labels(&logarithmic(1e-12, 1.0, 3.0)),
            ["10^{-12}", "10^{-9}", "10^{-6}", "10^{-3}", "10^{0}"]
        );
        assert_eq!(labels(&logarithmic(0.05, 1.0, 5.0)), ["0.05", "0.1", "0.2", "0.5", "1"]);
        assert_eq!(labels(&logarithmic(6.0, 9.0, 3.0)), ["6", "7", "8", "9"]);
    }

    #[test]
    fn ticks_lie_within_the_axis() {
        for (low, high) in [(0.3, 700.0), (2.5e-9, 3.5e-1), (1.0, 1e40), (0.011, 0.019)] {
            for tick in logarithmic(low, high, 6.0) {
                assert!(
                    (0.999 * low..=1.001 * high).contains(&tick.value),
                    "{low} {high} {tick:?}"
                );
            }
        }
    }
}
