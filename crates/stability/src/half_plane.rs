//! The half-plane right of a line: number and positions of the zeros of h in it.

use super::StabilityError;
use super::cell::Cell;
use super::certificate::{Certificate, ROUNDOFF, Region, Spectrum, with_conjugates};
use super::characteristic::Characteristic;
use super::newton::{MOST_ITERATIONS, another, pair, polish};
use super::winding::{argument_along, resolved, whole};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::stop;

/// Largest size of a contour, in units of 1/width; on the right |Λ| is below about √(10 α/r²).
const FARTHEST: f64 = 1e9;
/// A root with a relative error above this has another root close to it.
const BESIDE: f64 = 1e-10;
/// Largest number of Newton steps from a start close to a zero.
const SOON: usize = 10;
/// Difference of Λ²w² between the second and the first complex zero, where w is the length of [`Characteristic`]. It is
/// about that of the Gaussian and of the triple Gaussian with β = 1.
const FIRST_INTERVAL: Complex64 = Complex64::new(-5.5, -9.5);
/// Difference of Λ²w² between successive zeros far from the real axis, for the same footprints.
const FAR_INTERVAL: Complex64 = Complex64::new(-2.0, -12.5);
/// Λw of the first complex zero of these footprints, from large α to small.
const FIRST: [Complex64; 3] =
    [Complex64::new(-1.1, 3.7), Complex64::new(-2.2, 2.5), Complex64::new(-3.2, 1.8)];
/// Zeros with a larger Re p w do not belong to the chain.
const AHEAD_OF_CHAIN: f64 = 3.0;
/// Distances of starts to the left of an expected zero, times w.
const LEFT_OF_NEXT: [f64; 2] = [0.1, 0.35];
/// Largest number of shifts of a left edge that a root lies on.
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
    /// Counts the zeros; shifts the left edge if a zero lies on it.
    pub(super) fn counted(h: &Characteristic, left: f64) -> Result<Self, StabilityError> {
        // Right of the bound there is no zero.
        let left = left.min(2.0 * h.right_bound());
        if !(h.right_bound() * h.length < FARTHEST && (left * h.length).abs() < FARTHEST) {
            return Err(h.too_far_apart());
        }
        let shift = |n: u32| 1e-6 * f64::from(4_u32.pow(n) - 1) / h.length;
        let edges = (0..=MOST_SHIFTS).map(|n| left - shift(n));
        let mut edges = edges.filter(|edge| *edge >= h.analytic_from());
        let counted = edges.find_map(|edge| Self::counted_at(h, edge).ok());
        counted.ok_or(StabilityError::RootOnContour { re: left * h.r() })
    }

    fn counted_at(h: &Characteristic, left: f64) -> Result<Self, StabilityError> {
        // A root -1/r of α = 0 lies within the first term of each, those of α > 0 within the second.
        let right = (1.05 * h.right_bound()).max(left + 1.0 / h.length);
        let top = h.top_bound(left);
        let corner = |re, im| Complex64::new(re, im);
        let path = [corner(right, 0.0), corner(right, top), corner(left, top), corner(left, 0.0)];
        // h is real on the real axis: half the contour turns h by half as much.
        let turned = argument_along(|z| h.at(z), &resolved(&path, h.length, h.fading()))?;
        let count = whole(turned, PI).ok_or(StabilityError::RootOnContour { re: left * h.r() })?;
        Ok(Self { left, right, top, count })
    }

    pub(super) fn region(&self, r: f64) -> Region {
        Region { re_min: r * self.left, re_max: r * self.right, im_max: r * self.top }
    }

    pub(super) fn spectrum(&self, h: &Characteristic) -> Result<Spectrum, StabilityError> {
        self.spectrum_with(h, &[])
    }

    /// All zeros, some of which may be `known`.
    fn spectrum_with(
        &self,
        h: &Characteristic,
        known: &[Complex64],
    ) -> Result<Spectrum, StabilityError> {
        let certified = |upper: &[Complex64]| {
            let roots = with_conjugates(upper, h.r());
            let certificate = Certificate::of(h, self.region(h.r()), self.count, &roots);
            (roots, certificate)
        };
        let (mut roots, mut certificate) = certified(&self.by_deflation(h, known));
        if certificate.found != self.count {
            (roots, certificate) = certified(&self.by_halving(h)?);
        }
        if certificate.found != self.count {
            let Certificate { counted, found, .. } = certificate;
            return Err(StabilityError::RootsMissing { counted, found });
        }
        Ok(Spectrum { roots, certificate })
    }

    /// Zeros with Im Λ ≥ 0 by Newton's method, until their number equals the count. Starts lie along the chain that the
    /// zeros form, then on a grid. Most starts that lead to a zero do so in a few steps: only if zeros are missing after
    /// these, further steps are made.
    fn by_deflation(&self, h: &Characteristic, known: &[Complex64]) -> Vec<Complex64> {
        let mut upper: Vec<_> = known.iter().copied().filter(|z| self.contains(*z)).collect();
        self.add_first(h, &mut upper, self.count);
        let grid = self.grid(h);
        for (most, start) in
            [SOON, MOST_ITERATIONS].iter().flat_map(|n| grid.iter().map(move |z| (*n, *z)))
        {
            if total(&upper) >= self.count || stop::is_requested() {
                break;
            }
            if self.add_from(h, start, most, &mut upper) {
                self.add_chain(h, &mut upper, self.count);
            }
        }
        upper
    }

    fn contains(&self, zero: Complex64) -> bool {
        zero.re >= self.left && zero.re <= self.right && zero.im <= self.top
    }

    /// Adds the zero to which Newton's method leads from `start` in at most `most` steps, and its neighbour if this is too
    /// close for that method. Returns whether one of them is new.
    fn add_from(
        &self,
        h: &Characteristic,
        start: Complex64,
        most: usize,
        upper: &mut Vec<Complex64>,
    ) -> bool {
        let found = another(|z| h.at(z), start, upper, (2.0 / h.length, most));
        let is_new = |zero: &Complex64| {
            let apart =
                1e-8 * zero.norm().min(1.0 / h.length) + 4.0 * h.root_error(*zero, ROUNDOFF);
            self.contains(*zero) && upper.iter().all(|k| (k - zero).norm() > apart)
        };
        let zeros = found.into_iter().flat_map(|zero| settled(h, zero)).filter(is_new);
        let zeros: Vec<_> = zeros.filter(|z| h.relative_residual(*z) < 1e-9).collect();
        upper.extend(&zeros);
        !zeros.is_empty()
    }

    /// Adds zeros near the zeros of α = 0 and of large α, then the chain above them. The search ends when there are `count`
    /// zeros, or when the next one is not found where it is expected.
    fn add_first(&self, h: &Characteristic, upper: &mut Vec<Complex64>, count: usize) {
        let first = std::iter::once(Complex64::new(0.0, 0.8 / h.length));
        for start in first.chain(h.likely_roots()) {
            if total(&*upper) < count {
                self.add_from(h, start, SOON, upper);
            }
        }
        self.add_chain(h, upper, count);
    }

    /// Adds zeros of the chain upwards, each close to a position extrapolated from those below it.
    fn add_chain(&self, h: &Characteristic, upper: &mut Vec<Complex64>, count: usize) {
        while h.has_chain() && total(&*upper) < count && !stop::is_requested() {
            let starts = next_in_chain(upper, h.length, h.fading());
            if !starts.into_iter().any(|start| self.add_from(h, start, SOON, upper)) {
                break;
            }
        }
    }

    /// A grid of starts that widens upwards as the zeros do.
    fn grid(&self, h: &Characteristic) -> Vec<Complex64> {
        let mut starts = vec![];
        let spacing = 0.8 / h.length;
        let across = ((self.right.min(2.0 / h.length) - self.left) / spacing).clamp(1.0, 80.0);
        let up = (self.top.min(2.0 / h.length - self.left) / spacing).clamp(1.0, 80.0);
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
                length: h.length,
                fading: h.fading(),
                lower_left: Complex64::new(self.left, -below / h.length),
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

/// All zeros to the right of a line. The line is placed so that at least `count` zeros lie there, or all zeros if fewer
/// than `count` exist.
pub(super) fn leading(h: &Characteristic, count: usize) -> Result<Spectrum, StabilityError> {
    if let Some(left) = h.left_of_all() {
        return HalfPlane::counted(h, left)?.spectrum(h);
    }
    let count = h.degree().map_or(count, |degree| count.min(degree));
    let left = (-2.0 / h.length).max(h.leftmost());
    let further = |left: f64| (left - 1.0 / h.length).max(h.leftmost());
    let known = first_zeros(h, count);
    let seen = |left: f64| total(known.iter().filter(|z| z.re >= left));
    if total(&known) >= count {
        let edges = std::iter::successors(Some(left), |left| Some(further(*left)));
        let edge = edges.take_while(|left| *left > h.leftmost()).find(|left| seen(*left) >= count);
        let half_plane = edge.and_then(|edge| HalfPlane::counted(h, edge).ok());
        // If they are all, none of the lines before has enough zeros right of it.
        if let Some(all) = half_plane.filter(|found| found.count == seen(found.left)) {
            return all.spectrum_with(h, &known);
        }
    }
    first_with(h, count, left)?.spectrum_with(h, &known)
}

/// The first of the lines 1/width apart, from `left` on, with at least `count` zeros right of it; the leftmost if there
/// is none. If the surface heals within less than a width, the zeros begin at Re Λ = -s, many lines away. Therefore steps
/// grow after the first few, and the last one is bisected.
fn first_with(h: &Characteristic, count: usize, left: f64) -> Result<HalfPlane, StabilityError> {
    let has_enough = |edge: f64, found: &HalfPlane| found.count >= count || edge <= h.leftmost();
    let (mut left, mut found) = (left, HalfPlane::counted(h, left)?);
    let (mut passed, mut gap) = (0, if has_enough(left, &found) { 1 } else { u32::MAX });
    // From `left`, which has too few, to the nearest line known to have enough.
    while gap > 1 {
        let lines = (passed / 4).max(1).min(gap / 2);
        let edge = (left - f64::from(lines) / h.length).max(h.leftmost());
        let there = HalfPlane::counted(h, edge)?;
        if has_enough(edge, &there) {
            (gap, found) = (lines, there);
        } else {
            (left, passed, gap) = (edge, passed + lines, gap - lines);
        }
    }
    Ok(found)
}

/// Up to `count` zeros of the chain, without a certificate that none is left out.
fn first_zeros(h: &Characteristic, count: usize) -> Vec<Complex64> {
    let everywhere =
        HalfPlane { left: h.leftmost(), right: f64::INFINITY, top: f64::INFINITY, count };
    let mut known = vec![];
    everywhere.add_first(h, &mut known, count);
    known
}

/// Estimates of the next zero above the known ones. The zeros solve e^{p²w²/2} = R(p), p = Λ + s, with a nearly rational
/// R: far from the real axis, p²w² decreases by 4πi from one zero to the next.
fn next_in_chain(upper: &[Complex64], length: f64, fading: f64) -> Vec<Complex64> {
    let shifted = upper.iter().filter(|z| z.im > 0.0).map(|z| (z + fading) * length);
    let mut below: Vec<_> = shifted.filter(|p| p.re < AHEAD_OF_CHAIN).collect();
    sort_by_number(&mut below, |item| item.im);
    let square = match below[..] {
        [.., before, last] => {
            Some(last * last + (last * last - before * before + FAR_INTERVAL) * 0.5)
        }
        [only] => Some(only * only + FIRST_INTERVAL),
        [] => None,
    };
    let next = square.map(|square| Complex64::I * (-square).sqrt());
    // From the left, where N grows as e^{Λ²w²/2}, Newton's method does not overshoot.
    let expected = next.into_iter().flat_map(|next| LEFT_OF_NEXT.map(|left| next - left));
    let first = FIRST.into_iter().filter(|_| below.len() < 2);
    expected.chain(first).map(|z| z / length - fading).collect()
}

/// Number of zeros that `upper` represents: two for a conjugate pair, one if it is real.
fn total<'a>(upper: impl IntoIterator<Item = &'a Complex64>) -> usize {
    upper.into_iter().map(|z| if z.im > 0.0 { 2 } else { 1 }).sum()
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
    has_neighbour(h, z).then(|| pair(|z| h.at(z), z, 1.0 / h.length)).flatten()
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
            let by_deflation = with_conjugates(&half_plane.by_deflation(&h, &[]), 1.0);
            let by_halving = with_conjugates(&half_plane.by_halving(&h).unwrap(), 1.0);
            assert_eq!(by_deflation.len(), half_plane.count);
            assert_eq!(by_halving.len(), half_plane.count);
            for (a, b) in by_deflation.iter().zip(&by_halving) {
                assert!((a - b).norm() < 1e-11, "{a} {b}");
            }
        }
    }

    /// The line is the first of those 1/width apart with enough zeros right of it, however many of them were seen first.
    #[test]
    fn leading_zeros_are_those_of_the_first_line_with_enough() {
        let tips = [TipFunction::gaussian(1.0), TipFunction::triple_gaussian(1.0, 1.0)];
        for tip in tips.map(Result::unwrap) {
            for (alpha, r) in [(1.2, 1.0), (50.0, 1.0), (0.3, 0.1), (20.0, 10.0), (1e-3, 1.0)] {
                let h = Characteristic::new(&Model::new(tip.clone(), alpha, r).unwrap()).unwrap();
                let Certificate { region, counted, .. } = leading(&h, 8).unwrap().certificate;
                let counts = (2..).map(|n| HalfPlane::counted(&h, -f64::from(n) / h.length));
                let first = counts.map(Result::unwrap).find(|found| found.count >= 8).unwrap();
                assert_eq!(counted, first.count, "{alpha} {r}");
                assert!((region.re_min - r * first.left).abs() < 1e-12 * r, "{alpha} {r}");
            }
        }
    }

    /// Without the chain a grid of starts would have to find each.
    #[test]
    fn the_chain_leads_from_each_zero_to_the_next() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let h = Characteristic::new(&Model::new(tip, 1.2, 1.0).unwrap()).unwrap();
        let seen = first_zeros(&h, 40);
        let all = leading(&h, 40).unwrap().roots;
        assert!(
            total(&seen) >= 40 && seen.iter().all(|z| all.iter().any(|k| (k - z).norm() < 1e-9))
        );
    }
}
