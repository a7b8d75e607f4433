//! Zeros of an analytic function in a rectangle, by bisection of the rectangle: a search that misses none.

use super::StabilityError;
use super::newton::{pair, polish};
use super::transform::Scaled;
use super::winding::{argument_along, resolved, whole};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Zeros in a rectangle smaller than this, in units of 1/`length`, count as one multiple zero.
const SMALLEST: f64 = 1e-6;
/// So do zeros in a rectangle smaller than this fraction of its distance from the origin.
const SMALLEST_PART: f64 = 1e-12;
/// Two zeros in a rectangle smaller than this, in units of 1/`length`, are sought as a pair: lines between them would
/// pass too close to them.
const PAIR: f64 = 1e-3;
/// Newton's method has converged if its step is below this fraction of |z|.
const ARRIVED: f64 = 1e-11;

/// A rectangle of the Λ plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    /// A width of the tip: the function may vary over the inverse of this length.
    pub(super) length: f64,
    /// s = p - Λ, as in [`resolved`].
    pub(super) fading: f64,
    pub(super) lower_left: Complex64,
    pub(super) upper_right: Complex64,
}

impl Cell {
    pub(super) fn square(center: Complex64, half: f64, length: f64) -> Self {
        let corner = Complex64::new(half, half);
        Self { length, fading: 0.0, lower_left: center - corner, upper_right: center + corner }
    }

    fn contains(&self, z: Complex64) -> bool {
        (self.lower_left.re..=self.upper_right.re).contains(&z.re)
            && (self.lower_left.im..=self.upper_right.im).contains(&z.im)
    }

    /// Number of zeros inside, with multiplicity.
    pub(super) fn count(&self, h: &impl Fn(Complex64) -> Scaled) -> Result<usize, StabilityError> {
        let (a, c) = (self.lower_left, self.upper_right);
        let (b, d) = (Complex64::new(c.re, a.im), Complex64::new(a.re, c.im));
        let turned = argument_along(h, &resolved(&[a, b, c, d, a], self.length, self.fading))?;
        whole(turned, 2.0 * PI).ok_or(StabilityError::RootOnContour { re: a.re })
    }

    /// The two parts along the longer side, separated at this `fraction` of it.
    fn halves(&self, fraction: f64) -> [Self; 2] {
        let size = self.upper_right - self.lower_left;
        let (mut first, mut second) = (*self, *self);
        if size.re > size.im {
            let middle = self.lower_left.re + fraction * size.re;
            (first.upper_right.re, second.lower_left.re) = (middle, middle);
        } else {
            let middle = self.lower_left.im + fraction * size.im;
            (first.upper_right.im, second.lower_left.im) = (middle, middle);
        }
        [first, second]
    }

    /// All `count` zeros inside.
    pub(super) fn zeros(
        &self,
        h: &impl Fn(Complex64) -> Scaled,
        count: usize,
    ) -> Result<Vec<Complex64>, StabilityError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let center = (self.lower_left + self.upper_right) * 0.5;
        let size = (self.upper_right - self.lower_left).norm();
        if count == 2 && size < PAIR / self.length {
            let both = pair(h, center, 1.0 / self.length);
            if let Some(both) = both.filter(|both| both.iter().all(|z| self.contains(*z))) {
                return Ok(Vec::from(both));
            }
        }
        let smallest = (SMALLEST / self.length).max(SMALLEST_PART * center.norm());
        if size < smallest {
            return Ok(vec![near(h, center, smallest); count]);
        }
        if count == 1 {
            // Newton's method, given up on its way, may stop inside as well: twice as many steps.
            let zero = polish(h, polish(h, center));
            if self.contains(zero) && is_zero(h, zero) {
                return Ok(vec![zero]);
            }
        }
        let (halves, lower) = self.counted_halves(h)?;
        let mut zeros = halves[0].zeros(h, lower)?;
        zeros.extend(halves[1].zeros(h, count.saturating_sub(lower))?);
        Ok(zeros)
    }

    /// Two parts with no zero on their common side, and the number of zeros in the first.
    fn counted_halves(
        &self,
        h: &impl Fn(Complex64) -> Scaled,
    ) -> Result<([Self; 2], usize), StabilityError> {
        let mut last = StabilityError::RootOnContour { re: self.lower_left.re };
        for fraction in [0.5, 0.43, 0.57, 0.35, 0.65] {
            let halves = self.halves(fraction);
            match halves[0].count(h) {
                Ok(count) => return Ok((halves, count)),
                Err(error) => last = error,
            }
        }
        Err(last)
    }
}

/// The limit of Newton's method, or `center` if this limit is farther away than `radius`.
fn near(h: &impl Fn(Complex64) -> Scaled, center: Complex64, radius: f64) -> Complex64 {
    let zero = polish(h, center);
    if (zero - center).norm() <= radius { zero } else { center }
}

/// Whether the step of Newton's method at z is negligible.
fn is_zero(h: &impl Fn(Complex64) -> Scaled, z: Complex64) -> bool {
    let at = h(z);
    (at.value / at.derivative).norm() <= ARRIVED * z.norm()
}
