//! Zeros of an analytic function in a rectangle, by halving it: the search that cannot miss one.

use super::StabilityError;
use super::newton::polish;
use super::transform::Scaled;
use super::winding::{argument_along, whole};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Rectangles smaller than this fraction of the first hold one multiple zero.
const SMALLEST: f64 = 1e-7;
/// Newton's method has arrived where its step is below this fraction of where it is.
const ARRIVED: f64 = 1e-11;

/// A rectangle of the Λ plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) lower_left: Complex64,
    pub(super) upper_right: Complex64,
}

impl Cell {
    pub(super) fn square(center: Complex64, half: f64) -> Self {
        let corner = Complex64::new(half, half);
        Self { lower_left: center - corner, upper_right: center + corner }
    }

    fn contains(&self, z: Complex64) -> bool {
        (self.lower_left.re..=self.upper_right.re).contains(&z.re)
            && (self.lower_left.im..=self.upper_right.im).contains(&z.im)
    }

    /// Zeros inside, with their multiplicity.
    pub(super) fn count(&self, h: &impl Fn(Complex64) -> Scaled) -> Result<usize, StabilityError> {
        let (a, c) = (self.lower_left, self.upper_right);
        let (b, d) = (Complex64::new(c.re, a.im), Complex64::new(a.re, c.im));
        let turned = argument_along(h, &[a, b, c, d, a])?;
        whole(turned, 2.0 * PI).ok_or(StabilityError::RootOnContour { re: a.re })
    }

    /// The two halves along the longer side, parted at `fraction` of it.
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
        let size = (self.upper_right - self.lower_left).norm();
        self.zeros_above(h, count, SMALLEST * size)
    }

    fn zeros_above(
        &self,
        h: &impl Fn(Complex64) -> Scaled,
        count: usize,
        smallest: f64,
    ) -> Result<Vec<Complex64>, StabilityError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let center = (self.lower_left + self.upper_right) * 0.5;
        if (self.upper_right - self.lower_left).norm() < smallest {
            return Ok(vec![polish(h, center); count]);
        }
        if count == 1 {
            // Newton's method, given up on its way, may stop inside as well: twice as many steps.
            let zero = polish(h, polish(h, center));
            if self.contains(zero) && is_zero(h, zero) {
                return Ok(vec![zero]);
            }
        }
        let (halves, lower) = self.counted_halves(h)?;
        let mut zeros = halves[0].zeros_above(h, lower, smallest)?;
        zeros.extend(halves[1].zeros_above(h, count.saturating_sub(lower), smallest)?);
        Ok(zeros)
    }

    /// Halves whose common side no zero lies on, and the number of zeros in the first.
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

/// Whether Newton's method has no way to go from z.
fn is_zero(h: &impl Fn(Complex64) -> Scaled, z: Complex64) -> bool {
    let at = h(z);
    (at.value / at.derivative).norm() <= ARRIVED * z.norm()
}
