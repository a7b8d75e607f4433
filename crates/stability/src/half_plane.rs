//! The half-plane right of a line: number and positions of the zeros of h in it.

use super::StabilityError;
use super::cell::Cell;
use super::certificate::{Certificate, ROUNDOFF, Region};
use super::characteristic::Characteristic;
use super::newton::{MOST_ITERATIONS, another, pair, polish};
use super::spectrum::{Spectrum, with_conjugates};
use super::winding::{argument_along, resolved, whole};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::stop;

/// Largest size of a contour, in units of 1/width: |Λ| < √(10 α/r²) or so on the right.
const FARTHEST: f64 = 1e9;
/// A root with a relative error above this has another root close to it.
const BESIDE: f64 = 1e-10;
/// Largest number of Newton steps from a start close to a zero.
const SOON: usize = 10;
/// Largest number of shifts of a left edge that passes through a root.
const MOST_SHIFTS: u32 = 8;

/// Re Λ ≥ `left`; all zeros in it lie in the rectangle up to `right` and `top`.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfPlane {
    left: f64,
    right: f64,
    top: f64,
    pub(super) count: usize,
}

impl HalfPlane {
    /// Counts the zeros; shifts the edge if it passes through one.
    pub(super) fn counted(h: &Characteristic, left: f64) -> Result<Self, StabilityError> {
        if !(h.right_bound() * h.length() < FARTHEST && (left * h.length()).abs() < FARTHEST) {
            return Err(h.too_far_apart());
        }
        let shift = |n: u32| 1e-6 * f64::from(4_u32.pow(n) - 1) / h.length();
        let edges = (0..=MOST_SHIFTS).map(|n| left - shift(n));
        let mut edges = edges.filter(|edge| *edge >= h.analytic_from());
        let counted = edges.find_map(|edge| Self::counted_at(h, edge).ok());
        counted.ok_or(StabilityError::RootOnContour { re: left * h.r() })
    }

    fn counted_at(h: &Characteristic, left: f64) -> Result<Self, StabilityError> {
        // A root -1/r of α = 0 lies within the first term of each, those of α > 0 within the second.
        let right = (1.05 * h.right_bound()).max(left + 1.0 / h.length());
        let top = h.top_bound(left);
        let corner = |re, im| Complex64::new(re, im);
        let path = [corner(right, 0.0), corner(right, top), corner(left, top), corner(left, 0.0)];
        // h is real on the real axis: half the contour turns h by half as much.
        let turned = argument_along(|z| h.at(z), &resolved(&path, h.length()))?;
        let count = whole(turned, PI).ok_or(StabilityError::RootOnContour { re: left * h.r() })?;
        Ok(Self { left, right, top, count })
    }

    pub(super) fn region(&self, r: f64) -> Region {
        Region { re_min: r * self.left, re_max: r * self.right, im_max: r * self.top }
    }

    pub(super) fn spectrum(&self, h: &Characteristic) -> Result<Spectrum, StabilityError> {
        let certified = |upper: &[Complex64]| {
            let roots = with_conjugates(upper, h.r());
            let certificate = Certificate::of(h, self.region(h.r()), self.count, &roots);
            (roots, certificate)
        };
        let (mut roots, mut certificate) = certified(&self.by_deflation(h));
        if certificate.found != self.count {
            (roots, certificate) = certified(&self.by_halving(h)?);
        }
        if certificate.found != self.count {
            let Certificate { counted, found, .. } = certificate;
            return Err(StabilityError::RootsMissing { counted, found });
        }
        Ok(Spectrum { roots, certificate })
    }

    /// Zeros with Im Λ ≥ 0 from a grid of starts, until their number equals the count. Most starts that lead to a zero
    /// do so in a few steps: the iterations are continued only if zeros are missing after that.
    fn by_deflation(&self, h: &Characteristic) -> Vec<Complex64> {
        let starts = self.starts(h);
        let mut upper = Vec::new();
        for (most, start) in
            [SOON, MOST_ITERATIONS].iter().flat_map(|n| starts.iter().map(move |z| (*n, *z)))
        {
            if total(&upper) >= self.count || stop::is_asked() {
                break;
            }
            let Some(zero) = another(|z| h.at(z), start, &upper, (2.0 / h.length(), most)) else {
                continue;
            };
            let is_new = |zero: &Complex64| {
                let inside = zero.re >= self.left && zero.re <= self.right && zero.im <= self.top;
                let apart = 1e-8 * zero.norm().min(1.0 / h.length());
                inside && upper.iter().all(|k: &Complex64| (k - zero).norm() > apart)
            };
            let zeros = settled(h, zero).into_iter().filter(is_new);
            let zeros: Vec<_> = zeros.filter(|z| h.relative_residual(*z) < 1e-9).collect();
            upper.extend(zeros);
        }
        upper
    }

    /// The root of α = 0, those of large α, and a grid that widens upwards as the roots do.
    fn starts(&self, h: &Characteristic) -> Vec<Complex64> {
        let mut starts = vec![Complex64::new(0.0, 0.8 / h.length())];
        starts.extend(h.likely_roots());
        let spacing = 0.8 / h.length();
        let across = ((self.right.min(2.0 / h.length()) - self.left) / spacing).clamp(1.0, 80.0);
        let up = (self.top.min(2.0 / h.length() - self.left) / spacing).clamp(1.0, 80.0);
        let mut im = 0.1 * spacing;
        while im < up * spacing {
            let mut re = self.left;
            while re < self.left + across * spacing {
                starts.push(Complex64::new(re, im));
                re += spacing;
            }
            im += spacing;
        }
        starts
    }

    /// Zeros with Im Λ ≥ 0 by bisection of a rectangle that extends slightly below the real axis.
    pub(super) fn by_halving(&self, h: &Characteristic) -> Result<Vec<Complex64>, StabilityError> {
        let at = |z| h.at(z);
        for below in [0.0137, 0.0291, 0.0533] {
            let cell = Cell {
                length: h.length(),
                lower_left: Complex64::new(self.left, -below / h.length()),
                upper_right: Complex64::new(self.right, self.top),
            };
            let Ok(count) = cell.count(&at) else { continue };
            let zeros = cell.zeros(&at, count)?.into_iter();
            let mut zeros: Vec<Complex64> = zeros.map(|z| settled_alone(h, z)).collect();
            // Those just below the axis are conjugates of others found.
            zeros.retain(|z| z.im >= 0.0);
            return Ok(zeros);
        }
        Err(StabilityError::RootOnContour { re: self.left * h.r() })
    }
}

/// The half-plane right of a line, with at least `count` zeros if they exist.
pub(super) fn leading(h: &Characteristic, count: usize) -> Result<Spectrum, StabilityError> {
    if let Some(left) = h.left_of_all() {
        return HalfPlane::counted(h, left)?.spectrum(h);
    }
    let count = h.degree().map_or(count, |degree| count.min(degree));
    let mut left = -2.0 / h.length();
    loop {
        left = left.max(h.leftmost());
        let half_plane = HalfPlane::counted(h, left)?;
        if half_plane.count >= count || left <= h.leftmost() {
            return half_plane.spectrum(h);
        }
        left -= 1.0 / h.length();
    }
}

/// Number of zeros that `upper` represents: two for a conjugate pair, one if it is real.
fn total(upper: &[Complex64]) -> usize {
    upper.iter().map(|z| if z.im > 0.0 { 2 } else { 1 }).sum()
}

/// A zero on or above the real axis from Newton's method, and another one that is too close to it for that method.
fn settled(h: &Characteristic, z: Complex64) -> Vec<Complex64> {
    let above = Complex64::new(z.re, z.im.abs());
    let both = both(h, above).map_or_else(|| vec![snapped(h, above)], Vec::from);
    both.into_iter().filter(|z| z.im >= 0.0).collect()
}

/// z, on the real axis if it is real; of two zeros too close for Newton's method, the nearer one.
fn settled_alone(h: &Characteristic, z: Complex64) -> Complex64 {
    match both(h, z) {
        Some([a, b]) if (a - z).norm() <= (b - z).norm() => a,
        Some([_, b]) => b,
        None => snapped(h, z),
    }
}

fn both(h: &Characteristic, z: Complex64) -> Option<[Complex64; 2]> {
    has_neighbour(h, z).then(|| pair(|z| h.at(z), z, 1.0 / h.length())).flatten()
}

fn has_neighbour(h: &Characteristic, z: Complex64) -> bool {
    h.root_error(z, ROUNDOFF) > BESIDE * z.norm()
}

/// z, moved to the real axis if its imaginary part is round-off.
fn snapped(h: &Characteristic, z: Complex64) -> Complex64 {
    if z.im.abs() > 1e-6 * z.norm() + h.root_error(z, ROUNDOFF) {
        return z;
    }
    let real = polish(|z| h.at(Complex64::new(z.re, 0.0)), Complex64::new(z.re, 0.0));
    let real = Complex64::new(real.re, 0.0);
    let error = h.root_error(real, ROUNDOFF);
    if (real - z).norm() <= 100.0 * error { real } else { z }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::{Model, TipFunction};

    #[test]
    fn halving_finds_what_deflation_finds() {
        for (beta, alpha, r) in [(1.0, 1.2, 1.0), (0.0, 0.05, 0.3), (0.4, 900.0, 5.0)] {
            let tip = TipFunction::triple_gaussian(beta, 1.0).unwrap();
            let h = Characteristic::new(&Model::new(tip, alpha, r).unwrap()).unwrap();
            let half_plane = HalfPlane::counted(&h, -2.7).unwrap();
            let by_deflation = with_conjugates(&half_plane.by_deflation(&h), 1.0);
            let by_halving = with_conjugates(&half_plane.by_halving(&h).unwrap(), 1.0);
            assert_eq!(by_deflation.len(), half_plane.count);
            assert_eq!(by_halving.len(), half_plane.count);
            for (a, b) in by_deflation.iter().zip(&by_halving) {
                assert!((a - b).norm() < 1e-11, "{a} {b}");
            }
        }
    }
}
