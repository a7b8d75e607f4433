//! The argument principle: the number of zeros inside a contour from the change of arg h along it.

use super::StabilityError;
use super::transform::Scaled;
use num_complex::Complex64;
use stickslip_tip::stop;

/// Approximate largest change of arg h in a step, both as predicted by h' at either end and as computed.
const TURN: f64 = 0.7;
/// Largest difference between the change of h over a step and its prediction from h' at the ends, relative to h.
const AGREEMENT: f64 = 0.3;
/// A step below this fraction of a side of the contour means that a zero lies on the side.
const SHORTEST: f64 = 1e-13;
/// Largest number of steps on one side of a contour.
const MOST_STEPS: usize = 1_000_000;

/// Change of arg h in radians along the straight line from `from`, where h is `here`, to `to`, and h at `to`.
///
/// A step is first 0.7 |h/h'| long. It is halved until three conditions hold: it is no longer than about 0.7 |h/h'| at its
/// far end, h changes by no more than about 0.8 |h|, and this change agrees with h' at both ends. A turn would be missed
/// if h and h' were equal at both ends of a step but different between them. Therefore the corners of the contour must
/// be no further apart than the length over which h may vary.
///
/// # Errors
/// [`StabilityError::RootOnContour`] if h vanishes on the line.
fn argument_change(
    h: impl Fn(Complex64) -> Scaled,
    (from, mut here): (Complex64, Scaled),
    to: Complex64,
) -> Result<(f64, Scaled), StabilityError> {
    let length = (to - from).norm();
    if length <= 0.0 {
        return Ok((0.0, here));
    }
    let direction = (to - from) / length;
    let (mut at, mut turned) = (0.0, 0.0);
    for _ in 0..MOST_STEPS {
        if stop::is_requested() {
            return Err(StabilityError::Stopped);
        }
        let mut step = TURN * reach(&here).min(length);
        loop {
            if step < SHORTEST * length {
                return Err(StabilityError::RootOnContour { re: (from + direction * at).re });
            }
            let end = (at + step).min(length);
            let there = h(from + direction * end);
            let scale = (there.log_scale - here.log_scale).exp();
            let ratio = there.value / here.value * scale;
            let slopes = (here.derivative + there.derivative * scale) / here.value;
            let foretold = slopes * direction * (0.5 * (end - at));
            let agrees = (ratio - 1.0 - foretold).norm() < AGREEMENT * ratio.norm().min(1.0);
            if agrees && (ratio - 1.0).norm() < 1.2 * TURN && end - at < 1.5 * TURN * reach(&there)
            {
                turned += ratio.arg();
                (at, here) = (end, there);
                break;
            }
            step *= 0.5;
        }
        if at >= length {
            return Ok((turned, here));
        }
    }
    Err(StabilityError::RootOnContour { re: (from + direction * at).re })
}

/// |h/h'|: the distance over which the argument of h changes little.
fn reach(h: &Scaled) -> f64 {
    h.value.norm() / h.derivative.norm().max(f64::MIN_POSITIVE)
}

/// Change of arg h along the closed or open polygon through `corners`.
pub(super) fn argument_along(
    h: impl Fn(Complex64) -> Scaled,
    corners: &[Complex64],
) -> Result<f64, StabilityError> {
    let Some(first) = corners.first() else { return Ok(0.0) };
    let start = (*first, h(*first), 0.0);
    let end = corners.iter().skip(1).try_fold(start, |(from, here, turned), to| {
        let (more, there) = argument_change(&h, (from, here), *to)?;
        Ok((*to, there, turned + more))
    });
    end.map(|(_, _, turned)| turned)
}

/// The path with further corners, so that h varies little from one to the next. They are 0.3/`length` apart, or 0.2 of
/// the smaller of |Λ| and |p|, p = Λ + `fading`, if this is larger and the exponential of p² in h is negligible.
pub(super) fn resolved(path: &[Complex64], length: f64, fading: f64) -> Vec<Complex64> {
    let spacing = |z: Complex64| {
        let p = z + fading;
        let algebraic = p.im + 1.5 * p.re.min(0.0) > 10.0 / length || p.re > 0.0;
        (0.3 / length).max(if algebraic { 0.2 * z.norm().min(p.norm()) } else { 0.0 })
    };
    let mut corners: Vec<Complex64> = path.iter().take(1).copied().collect();
    for side in path.windows(2) {
        let (mut at, to) = (side[0], side[1]);
        while (to - at).norm() > spacing(at) {
            at += (to - at) / (to - at).norm() * spacing(at);
            corners.push(at);
        }
        corners.push(to);
    }
    corners
}

/// `turned` in units of `unit`, if that is a whole number ≥ 0.
pub(super) fn whole(turned: f64, unit: f64) -> Option<usize> {
    let count = turned / unit;
    let rounded = count.round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
    ((count - rounded).abs() < 1e-6 && rounded >= 0.0).then_some(rounded as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// e^{kz} - 1: zeros at 2πin/k, so that the number in a rectangle is known.
    #[test]
    fn zeros_of_an_exponential_are_counted() {
        for k in [1.0, 7.3, 40.0] {
            let h = |z: Complex64| {
                let e = (z * k).exp();
                Scaled { value: e - 1.0, derivative: e * k, log_scale: 0.0 }
            };
            let corner = |re, im| Complex64::new(re, im);
            let (low, high) = (-0.4, 5.1);
            let path = [
                corner(-1.0, low),
                corner(1.0, low),
                corner(1.0, high),
                corner(-1.0, high),
                corner(-1.0, low),
            ];
            let spacing = 2.0 * PI / k;
            let expected = (high / spacing).floor() - (low / spacing).ceil() + 1.0;
            let turned = argument_along(h, &path).unwrap();
            assert!((turned / (2.0 * PI) - expected).abs() < 1e-9, "{k}: {turned} {expected}");
        }
    }

    #[test]
    fn a_zero_on_the_contour_is_refused() {
        let h = |z: Complex64| Scaled { value: z, derivative: Complex64::ONE, log_scale: 0.0 };
        let side = argument_along(h, &[Complex64::new(-1.0, 0.0), Complex64::new(1.0, 0.0)]);
        assert!(matches!(side, Err(StabilityError::RootOnContour { .. })));
    }

    #[test]
    fn a_scale_carried_apart_makes_no_difference() {
        let plain = |z: Complex64| Scaled { value: z, derivative: Complex64::ONE, log_scale: 0.0 };
        let scaled = |z: Complex64| {
            let log_scale = 3.0 * z.re;
            let down = (-log_scale).exp();
            Scaled { value: z * down, derivative: Complex64::ONE * down, log_scale }
        };
        let (from, to) = (Complex64::new(-1.0, 0.3), Complex64::new(2.0, 0.1));
        let turns = [argument_along(plain, &[from, to]), argument_along(scaled, &[from, to])];
        assert!((turns[0].unwrap() - turns[1].unwrap()).abs() < 1e-12);
    }
}
