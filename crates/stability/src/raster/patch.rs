//! Complex functions on a rectangle of wave numbers and phases: a value at its centre, slopes, and a bound of the rest.

use num_complex::Complex64;
use std::ops::{Add, Mul, Sub};

/// f(x, y) = value + along\[0\] x + along\[1\] y + e(x, y) for all real |x|, |y| ≤ 1, with |e| ≤ rest.
///
/// Sums, products and reciprocals of such functions have the same form, with bounds that hold for all x and y except for
/// round-off.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patch {
    pub(super) value: Complex64,
    pub(super) along: [Complex64; 2],
    pub(super) rest: f64,
}

impl Patch {
    pub(super) fn constant(value: impl Into<Complex64>) -> Self {
        Self { value: value.into(), along: [Complex64::ZERO; 2], rest: 0.0 }
    }

    /// A bound of |f - value|.
    pub(super) fn reach(&self) -> f64 {
        self.slopes() + self.rest
    }

    /// A bound of |f|.
    pub(super) fn size(&self) -> f64 {
        self.value.norm() + self.reach()
    }

    /// f* (x and y are real).
    pub(super) fn conj(self) -> Self {
        Self { value: self.value.conj(), along: self.along.map(|l| l.conj()), rest: self.rest }
    }

    /// 1/f; its rest is infinite if f may vanish.
    pub(super) fn inv(self) -> Self {
        let inverse = self.value.inv();
        let (size, reach) = (self.value.norm(), self.reach());
        let square = inverse * inverse;
        let rest = if reach < size {
            (self.rest + reach * reach / (size - reach)) / (size * size)
        } else {
            f64::INFINITY
        };
        Self { value: inverse, along: self.along.map(|l| -(l * square)), rest }
    }

    /// A lower bound of |f - t| over all real t ≤ 0: the distance of f from the negative real axis.
    pub(super) fn distance_to_negative(&self) -> f64 {
        let least = |part: fn(&Complex64) -> f64| {
            let slopes: f64 = self.along.iter().map(|l| part(l).abs()).sum();
            (part(&self.value), slopes + self.rest)
        };
        let ((re, off_re), (im, off_im)) = (least(|z| z.re), least(|z| z.im));
        (re - off_re).max(im.abs() - off_im).max(0.0)
    }

    fn slopes(&self) -> f64 {
        self.along[0].norm() + self.along[1].norm()
    }
}

impl Add for Patch {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let along = [self.along[0] + other.along[0], self.along[1] + other.along[1]];
        Self { value: self.value + other.value, along, rest: self.rest + other.rest }
    }
}

impl Sub for Patch {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul for Patch {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let along =
            [0, 1].map(|i: usize| self.value * other.along[i] + self.along[i] * other.value);
        let (slopes, others) = (self.slopes(), other.slopes());
        let rest = slopes * others
            + self.rest * (other.value.norm() + others + other.rest)
            + other.rest * (self.value.norm() + slopes);
        Self { value: self.value * other.value, along, rest }
    }
}

impl Mul<f64> for Patch {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        let along = self.along.map(|l| l * factor);
        Self { value: self.value * factor, along, rest: self.rest * factor.abs() }
    }
}

/// An entry of the matrix N of `determinant.rs`, a function of q that may be multiplied by sums over the earlier lines:
/// own + Σ_l `lines`_l Λ_l, where `own` and `lines` are functions of q on an interval.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) own: Patch,
    pub(super) lines: Vec<Patch>,
    /// Order of the derivative of h in Λ = Σ_j c^j h(jd) w^j.
    pub(super) order: usize,
}

impl Entry {
    /// An entry with Λ of h itself, of order 0.
    pub(super) fn level(own: Patch, lines: Vec<Patch>) -> Self {
        Self { own, lines, order: 0 }
    }

    /// The value of the entry, given Λ_l of h, h' and h''.
    pub(super) fn with(&self, sums: &[Vec<Patch>]) -> Patch {
        self.own + self.felt(sums)
    }

    pub(super) fn felt(&self, sums: &[Vec<Patch>]) -> Patch {
        let sums = sums.get(self.order).map_or(&[][..], Vec::as_slice);
        let each = self.lines.iter().zip(sums);
        each.fold(Patch::constant(0.0), |felt, (line, sum)| felt + *line * *sum)
    }

    pub(super) fn conj(&self) -> Self {
        let lines = self.lines.iter().map(|l| l.conj()).collect();
        Self { own: self.own.conj(), lines, order: self.order }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials in x and y, evaluated at many places: none is outside of what the patch says.
    #[test]
    fn what_a_patch_says_holds_everywhere() {
        let c = Complex64::new;
        let one = Patch { value: c(1.3, -0.4), along: [c(0.2, 0.1), c(-0.1, 0.3)], rest: 0.0 };
        let two = Patch { value: c(-0.7, 0.9), along: [c(0.1, -0.2), c(0.05, 0.1)], rest: 0.0 };
        let exact = |p: &Patch, x: f64, y: f64| p.value + p.along[0] * x + p.along[1] * y;
        let product = one * two + two.inv() * one.conj() - one.inv() * 0.3;
        let mut largest = 0.0_f64;
        for i in -10..=10 {
            for j in -10..=10 {
                let (x, y) = (0.1 * f64::from(i), 0.1 * f64::from(j));
                let (f, g) = (exact(&one, x, y), exact(&two, x, y));
                let wanted = f * g + f.conj() / g - 0.3 / f;
                let off = (wanted - exact(&product, x, y)).norm();
                assert!(off <= product.rest, "{off} {}", product.rest);
                assert!((wanted - product.value).norm() <= product.reach());
                assert!(wanted.norm() <= product.size());
                largest = largest.max(off);
            }
        }
        // The bound is no more than some times too large.
        assert!(largest > 0.1 * product.rest, "{largest} {}", product.rest);
        assert!(Patch { along: [c(2.0, 0.0); 2], ..one }.inv().rest.is_infinite());
        assert!((Patch::constant(c(-3.0, 0.5)).distance_to_negative() - 0.5).abs() < 1e-15);
        assert!((Patch::constant(c(3.0, 0.5)).distance_to_negative() - 3.0).abs() < 1e-15);
    }
}
