//! A value with its interval, and the ends of intervals by profile likelihood.

use statrs::distribution::{ContinuousCDF, StudentsT};
use stickslip_tip::sorting::sort_numbers;

/// An estimate with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Lower end; −∞ if the data exclude no small value.
    pub low: f64,
    /// Upper end; ∞ if the data exclude no large value.
    pub high: f64,
}

impl Estimate {
    /// The interval of this half length about a value.
    pub(crate) fn about(value: f64, error: f64) -> Self {
        Self { value, low: value - error, high: value + error }
    }

    /// Half the length of the interval, relative to the value.
    pub fn relative(&self) -> f64 {
        0.5 * (self.high - self.low) / self.value.abs()
    }

    /// Whether the interval contains a value.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// The estimate in another unit: value and ends times a factor above 0.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        let Self { value, low, high } = self;
        Self { value: value * factor, low: low * factor, high: high * factor }
    }

    /// The interval with an independent error of this factor added: the logarithms of both are added in quadrature.
    #[must_use]
    pub fn wider_by(self, factor: f64) -> Self {
        let moved = |end: f64| {
            let length = (end / self.value).ln();
            self.value * (length.signum() * f64::hypot(length, factor.ln())).exp()
        };
        let out = |end: f64, other: f64| if end.is_finite() { end.min(other) } else { end };
        Self {
            value: self.value,
            low: out(self.low, moved(self.low.min(self.value * (1.0 - f64::EPSILON)))),
            high: if self.high.is_finite() {
                self.high.max(moved(self.high.max(self.value * (1.0 + f64::EPSILON))))
            } else {
                self.high
            },
        }
    }

    /// The interval between percentiles of resampled values; the widest one over several ways of resampling.
    pub(crate) fn of_resamples(value: f64, ways: &[Vec<f64>]) -> Self {
        let mut found: Option<Self> = None;
        for resamples in ways {
            let mut sorted: Vec<f64> =
                resamples.iter().copied().filter(|v| v.is_finite()).collect();
            if sorted.is_empty() {
                continue;
            }
            sort_numbers(&mut sorted);
            let (low, high) = (quantile(&sorted, 0.5 - HALF), quantile(&sorted, 0.5 + HALF));
            // An interval without its own estimate would puzzle.
            let before = found.unwrap_or(Self { value, low: value, high: value });
            found = Some(Self { value, low: before.low.min(low), high: before.high.max(high) });
        }
        found.unwrap_or(Self { value, low: f64::NEG_INFINITY, high: f64::INFINITY })
    }
}

/// Half of the probability within an interval.
const HALF: f64 = 0.475;

/// 97.5 % quantile of Student's distribution with this number of degrees of freedom.
pub(crate) fn student(freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom.min(1e4)).map_or(f64::INFINITY, |law| law.inverse_cdf(0.975))
}

/// The median, or the larger one of the two values in the middle; `None` if there are no values.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sort_numbers(&mut sorted);
    sorted.get(sorted.len() / 2).copied()
}

/// Quantile of sorted values, interpolated.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = share.clamp(0.0, 1.0) * (sorted.len() - 1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index")]
    let below = (at as usize).min(sorted.len() - 1);
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (at - below as f64) * (sorted[above] - sorted[below])
}

/// Largest number of points of a profile on either side.
const MOST_POINTS: usize = 7;
/// Tolerance of the root at the end of an interval.
const MET: f64 = 0.02;

/// The offset at which `root` reaches `wanted`, and the points evaluated on the way there. The root is 0 at an offset of 0.
/// The search starts from a guess; the offset is `None` if it is not below `most`.
pub(crate) fn crossing(
    root: impl Fn(f64) -> Option<f64>,
    wanted: f64,
    (guess, most): (f64, f64),
) -> (Option<f64>, Vec<(f64, f64)>) {
    let side = guess.signum();
    let mut offset = guess;
    // Below it too little is left, above it too much.
    let (mut inside, mut outside): ((f64, f64), Option<(f64, f64)>) = ((0.0, 0.0), None);
    let mut points = vec![];
    for _ in 0..MOST_POINTS {
        let root = root(offset).unwrap_or(f64::INFINITY);
        if root.is_finite() {
            points.push((offset, root));
        }
        if (root - wanted).abs() < MET * wanted {
            return (Some(offset), points);
        }
        if root < wanted {
            if offset.abs() >= most {
                return (None, points);
            }
            inside = (offset, root);
        } else {
            outside = Some((offset, root));
        }
        offset = match outside {
            Some((far, root)) if root.is_finite() => {
                let part = (wanted - inside.1) / (root - inside.1);
                inside.0 + part.clamp(0.05, 0.95) * (far - inside.0)
            }
            Some((far, _)) => 0.5 * (inside.0 + far),
            None => {
                let further = wanted / inside.1.max(0.2 * wanted) * 1.05;
                side * (offset.abs() * further).min(most)
            }
        };
    }
    (outside.map(|_| offset), points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_those_of_the_widest_sample() {
        let sample = |middle: f64| -> Vec<f64> {
            (0..=1000).map(|i| middle + 0.001 * f64::from(i) - 0.5).collect()
        };
        let found = Estimate::of_resamples(5.0, &[sample(5.0)]);
        assert!((found.low - 4.525).abs() < 1e-9 && (found.high - 5.475).abs() < 1e-9, "{found:?}");
        let wider = Estimate::of_resamples(5.0, &[sample(5.0), sample(5.2), vec![f64::NAN]]);
        assert!((wider.low - 4.525).abs() < 1e-9 && (wider.high - 5.675).abs() < 1e-9);
        assert!(wider.holds(5.6) && !found.holds(5.6));
        assert!(Estimate::of_resamples(5.0, &[]).relative().is_infinite());
    }
}
