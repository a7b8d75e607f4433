//! Q on a cell of wave numbers and phases, as a function of T: where it cannot vanish, and where it may.

use super::patch::Patch;
use super::polynomial::Polynomial;
use num_complex::Complex64;

/// Q(T + τ) = value + slope τ, and + τ² where `curved`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Determinant {
    pub(super) value: Patch,
    pub(super) slope: Patch,
    pub(super) curved: bool,
    /// T - N11, T - N22 and N12 N21.
    factors: Option<[Patch; 3]>,
    /// All of Q if the tip is flexible across the lines.
    plane: Option<Polynomial>,
}

impl Determinant {
    /// Q = T - A, given its value at this T.
    pub(super) fn linear(value: Patch) -> Self {
        let slope = Patch::constant(1.0);
        Self { value, slope, curved: false, factors: None, plane: None }
    }

    /// Q of two rows: (T - N11)(T - N22) - N12 N21.
    pub(super) fn of_two([x, y, product]: [Patch; 3]) -> Self {
        let (value, slope) = (x * y - product, x + y);
        Self { value, slope, curved: true, factors: Some([x, y, product]), plane: None }
    }

    /// Q for a tip that is flexible across the lines.
    pub(super) fn in_plane(q: Polynomial) -> Self {
        let (value, slope) = (q.value(), q.slope());
        Self { value, slope, curved: true, factors: None, plane: Some(q) }
    }

    /// The largest τ at which Q(T + τ) would vanish at the centre of the cell if it were real there.
    pub(super) fn beyond(&self) -> f64 {
        if let Some(plane) = &self.plane {
            return plane.largest();
        }
        let (value, slope) = (self.value.value, self.slope.value);
        if self.curved {
            let root = (0.25 * slope * slope - value).sqrt();
            (-0.5 * slope.re) + root.re.abs()
        } else {
            -(value / slope).re
        }
    }

    /// Estimates of all τ at which Q(T + τ) may vanish on the cell; empty unless the tip is flexible across the lines.
    pub(super) fn near_axis(&self) -> Vec<f64> {
        self.plane.as_ref().map_or_else(Vec::new, Polynomial::near_axis)
    }

    /// Whether Q has no zero at this T or any larger real one, anywhere on the cell.
    pub(super) fn has_no_zero(&self) -> bool {
        if let Some(plane) = &self.plane {
            return plane.has_no_zero();
        }
        if let Some([x, y, product]) = &self.factors
            && x.distance_to_negative() * y.distance_to_negative() > product.size()
        {
            return true;
        }
        self.is_beside_axis() || self.multipliers().any(|mu| self.is_positive(mu))
    }

    /// Estimate, to first order, of how close the cell and its neighbours come to a zero of Q; larger is closer.
    pub(super) fn promise(&self) -> f64 {
        if let Some(plane) = &self.plane {
            return plane.promise();
        }
        let turned: f64 = self.value.along.iter().map(|l| l.im.abs()).sum();
        if self.value.value.im.abs() > 2.0 * turned {
            return f64::NEG_INFINITY;
        }
        let least = |mu: f64| self.part(&self.value, mu, 0.0);
        let most = self.multipliers().map(least).fold(f64::NEG_INFINITY, f64::max);
        -most / self.slope.value.norm()
    }

    /// Whether Re (1 - iμ) Q > 0 at this T and all larger ones, so that Q ≠ 0.
    fn is_positive(&self, mu: f64) -> bool {
        let value = self.part(&self.value, mu, 1.0);
        let slope = self.part(&self.slope, mu, 1.0);
        value > 0.0 && (slope >= 0.0 || self.curved && slope * slope < 4.0 * value)
    }

    /// Whether at this T and all larger ones Im Q ≠ 0, or Re Q ≠ 0 where Im Q may vanish.
    fn is_beside_axis(&self) -> bool {
        let range = |f: &Patch, part: fn(&Complex64) -> f64| {
            let slopes: f64 = f.along.iter().map(|l| part(l).abs()).sum();
            let off = slopes + f.rest;
            (part(&f.value) - off, part(&f.value) + off)
        };
        let (low, high) = range(&self.value, |z| z.im);
        if !self.curved {
            return low > 0.0 || high < 0.0;
        }
        // Neither is so where a bound is infinite, and times 0 no number.
        if !(low > 0.0 || high < 0.0) {
            return false;
        }
        // Im Q = value + slope τ of the other sign at 0: what brings it to 0 is a slope towards it.
        let (least, most) = range(&self.slope, |z| z.im);
        let (near, far) = if low > 0.0 { (low, high) } else { (-high, -low) };
        let (steepest, flattest) = if low > 0.0 { (-least, -most) } else { (most, least) };
        if steepest <= 0.0 {
            return true;
        }
        let first = near / steepest;
        if !first.is_finite() {
            return false;
        }
        let last = if flattest > 0.0 { far / flattest } else { f64::INFINITY };
        let (value, slope) = (range(&self.value, |z| z.re), range(&self.slope, |z| z.re));
        // Re Q = value + slope τ + τ² from the first to the last of these τ: below 0 at both ends, or above 0 throughout.
        let below = |tau: f64| value.1 + (slope.1 + tau) * tau < 0.0;
        let least = (-0.5 * slope.0).clamp(first, last.max(first));
        let above = value.0 + (slope.0 + least) * least > 0.0;
        above || last.is_finite() && below(first) && below(last)
    }

    /// The smallest Re (1 - iμ) f on the cell, if the bound of the rest of f is multiplied by `rests`.
    fn part(&self, f: &Patch, mu: f64, rests: f64) -> f64 {
        let part = |z: &Complex64| z.re + mu * z.im;
        let slopes: f64 = f.along.iter().map(|l| part(l).abs()).sum();
        part(&f.value) - slopes - rests * (1.0 + mu * mu).sqrt() * f.rest
    }

    /// Lagrange multipliers μ for the smallest Re Q under the condition Im Q = 0, to first order on the cell: the dual
    /// problem has its maximum at one of these.
    fn multipliers(&self) -> impl Iterator<Item = f64> {
        let each = self.value.along.map(|l| -l.re / l.im);
        std::iter::once(0.0).chain(each).filter(|mu| mu.is_finite())
    }
}
