//! Bounds of the transforms of a footprint and of their second derivatives, from integrals over it.

use stickslip_tip::TipFunction;

/// Smallest and largest number of samples of f over its reach, from which its integrals are bounded.
const SAMPLES: (f64, f64) = (256.0, 4000.0);
/// A sum of more Gaussians than this is a table, smooth between its rows.
const MOST_TERMS: usize = 16;
/// Safety factor between sums over the samples and the bounds.
const MARGIN: f64 = 1.2;

/// Bounds of the transform F = ∫ f e^{-px}dx, over x > 0 or all x, and of those of f' and f'', in this order:
/// |F| ≤ `area` and ≤ `decay`/|p|, and |F''| ≤ `second` and ≤ `bend`/|p|².
///
/// ```text
///     area = ∫|f|W,   decay = |f(0)| + ∫|f'|W,   second = ∫x²|f|W,   bend = ∫|(x²f)''|W
/// ```
///
/// where W bounds e^{-Re(p)x}; those with |p| follow by parts, once and twice.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Extent {
    pub(super) area: [f64; 3],
    pub(super) decay: [f64; 3],
    pub(super) second: [f64; 3],
    pub(super) bend: [f64; 3],
}

impl Extent {
    /// Bounds of transforms over x > 0, for Re p ≥ 0.
    pub(super) fn one_sided(tip: &TipFunction) -> Self {
        Self::weighted(tip, true, |_| 1.0)
    }

    /// Bounds of transforms over all x, for Re p = `fading`.
    pub(super) fn two_sided(tip: &TipFunction, fading: f64) -> Self {
        if tip.is_even() {
            return Self::weighted(tip, false, |x| 2.0 * (fading * x).cosh());
        }
        let sides = [tip, &tip.mirrored()];
        let [one, other] = sides.map(|tip| Self::weighted(tip, false, |x| (fading * x).exp()));
        let both =
            |of: fn(&Self) -> [f64; 3]| [0, 1, 2].map(|i: usize| of(&one)[i] + of(&other)[i]);
        Self {
            area: both(|side| side.area),
            decay: both(|side| side.decay),
            second: both(|side| side.second),
            bend: both(|side| side.bend),
        }
    }

    /// Bounds of |F''| for |p| ≥ `distance`, of f, f' and f''.
    pub(super) fn curvature(&self, distance: f64) -> [f64; 3] {
        [0, 1, 2].map(|i: usize| self.second[i].min(self.bend[i] / (distance * distance)))
    }

    fn weighted(tip: &TipFunction, has_edge: bool, weight: impl Fn(f64) -> f64) -> Self {
        let reach = tip.reach().unwrap_or(1.0);
        let is_table = matches!(tip, TipFunction::Gaussians(sum) if sum.terms().len() > MOST_TERMS);
        let wanted = if is_table { SAMPLES.0 } else { 4.0 * reach * tip.band() };
        let samples = wanted.clamp(SAMPLES.0, SAMPLES.1).ceil();
        let Self { area, decay, second, bend } = Self::summed(tip, samples, has_edge, weight);
        let [area, decay, second, bend] =
            [area, decay, second, bend].map(|all| all.map(|f| MARGIN * f));
        Self { area, decay, second, bend }
    }

    /// The sums over x > 0 at this number of samples, without a safety factor; |f(0)| counts if f ends there.
    pub(super) fn summed(
        tip: &TipFunction,
        samples: f64,
        has_edge: bool,
        weight: impl Fn(f64) -> f64,
    ) -> Self {
        let reach = tip.reach().unwrap_or(1.0);
        let step = reach / samples;
        let mut extent = Self::default();
        let mut last = tip.value_slope_and_curvature(0.0);
        if has_edge {
            extent.decay = last.map(f64::abs);
        }
        // (x²f)' over the last step; 0 at 0.
        let mut slopes = [0.0; 3];
        let mut x = 0.0;
        while x < reach {
            let here = tip.value_slope_and_curvature(x + step);
            let w = weight(x + step);
            let (from, to) = (x * x, (x + step) * (x + step));
            for i in 0..3 {
                extent.area[i] += 0.5 * w * step * (here[i].abs() + last[i].abs());
                extent.decay[i] += w * (here[i] - last[i]).abs();
                extent.second[i] += 0.5 * w * step * (to * here[i].abs() + from * last[i].abs());
                let slope = (to * here[i] - from * last[i]) / step;
                extent.bend[i] += w * (slope - slopes[i]).abs();
                slopes[i] = slope;
            }
            (last, x) = (here, x + step);
        }
        extent
    }
}
