//! All roots λ right of a line, with a certificate that none is missing: of (30), or for J0 of (44).

use super::certificate::{Certificate, Spectrum};
use super::characteristic::Characteristic;
use super::half_plane::{HalfPlane, leading};
use super::{StabilityError, bessel_roots};
use num_complex::Complex64;
use stickslip_tip::{Model, TipFunction};

/// All roots λ of (29) with Re λ ≥ `bound`.
///
/// The number of roots comes from the argument principle on a rectangle whose left side is Re λ = `bound`. By the
/// bounds in `docs/explanation/linear-theory.md`, h of (30) cannot vanish beyond the other three sides, so that the
/// number holds for the whole half-plane. Roots come from Newton's method with deflation on a grid of starts, and, if
/// it finds fewer than were counted, from bisection of the rectangle. Each is polished to round-off; two that
/// are close to a double root are computed together from the zero of h'. If a root lies on Re λ = `bound`,
/// the left side is moved slightly to the left: see the region of the certificate.
///
/// For J0, (44) continues to Re λ < 0 in the plane cut from ±ir straight to the left. Roots of the squared equation on
/// the other sheet of the square root are left out. The choice of the cuts does not affect roots on the imaginary axis
/// and right of it. In the extended model only roots right of these branch points are available.
///
/// # Errors
/// [`StabilityError::Bound`], [`StabilityError::RootOnContour`], [`StabilityError::RootsMissing`];
/// [`StabilityError::NoSupport`] and [`StabilityError::Corner`] where there is no linear theory,
/// [`StabilityError::BranchPoints`].
pub fn roots(model: &Model, bound: f64) -> Result<Spectrum, StabilityError> {
    if !bound.is_finite() {
        return Err(StabilityError::Bound(bound));
    }
    if has_closed_form(model) {
        return bessel_roots::spectrum(model, Some(bound));
    }
    let h = Characteristic::new(model)?;
    counted(&h, bound / model.r())?.spectrum(&h).map_err(|error| h.explain(error))
}

/// At least `count` leading roots: all roots right of a line that is chosen far enough to the left.
///
/// The list is shorter if no more roots exist (α = 0: only the root -1; J0), or if the others lie left of
/// Re Λ ≈ -60/width. For a table this limit is Re Λ = -24/reach: left of it, round-off of the entries, amplified by
/// e^{-Λy}, would cause spurious roots.
///
/// # Errors
/// As [`roots`].
pub fn leading_roots(model: &Model, count: usize) -> Result<Spectrum, StabilityError> {
    if has_closed_form(model) {
        return bessel_roots::spectrum(model, None);
    }
    let h = Characteristic::new(model)?;
    leading(&h, count).map_err(|error| h.explain(error))
}

/// Number of roots right of the imaginary axis: 0 if steady motion is stable. If a root lies on the axis, roots are
/// counted right of a line slightly to its left.
///
/// # Errors
/// As [`roots`].
pub fn unstable_count(model: &Model) -> Result<usize, StabilityError> {
    if has_closed_form(model) {
        return Ok(bessel_roots::spectrum(model, Some(0.0))?.certificate.counted);
    }
    Ok(counted(&Characteristic::new(model)?, 0.0)?.count)
}

/// Checks a list of roots λ against a new count of those with Re λ ≥ `bound`.
///
/// If a root is missing, listed twice or displaced, [`Certificate::is_complete`] is false.
///
/// # Errors
/// As [`roots`].
pub fn certify(
    model: &Model,
    bound: f64,
    roots: &[Complex64],
) -> Result<Certificate, StabilityError> {
    if has_closed_form(model) {
        return bessel_roots::certify(model, bound, roots);
    }
    let h = Characteristic::new(model)?;
    let half_plane = counted(&h, bound / model.r())?;
    Ok(Certificate::of(&h, half_plane.region(model.r()), half_plane.count, roots))
}

/// Whether the roots are those of a quartic, as for J0 in the basic model.
fn has_closed_form(model: &Model) -> bool {
    *model.tip() == TipFunction::Bessel && model.wider().is_basic()
}

fn counted(h: &Characteristic, left: f64) -> Result<HalfPlane, StabilityError> {
    if left < h.analytic_from() {
        let (least, bound) = (h.analytic_from() * h.r(), left * h.r());
        return Err(StabilityError::BranchPoints { least, bound });
    }
    HalfPlane::counted(h, left).map_err(|error| h.explain(error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critical;
    use stickslip_tip::Wider;

    /// Between two places on the imaginary axis where h and h' were much the same, a step passed by the
    /// pair that had just crossed it at r = 0.2.
    #[test]
    fn a_pair_just_across_the_axis_is_counted() {
        for beta in [0.0, 0.5, 0.9, 1.0] {
            let tip = TipFunction::triple_gaussian(beta, 1.0).unwrap();
            for r in [0.01, 0.05, 0.1, 0.2, 0.3, 0.7, 2.0, 10.0, 100.0] {
                let alpha = critical(&Wider::default(), &tip, r).unwrap().alpha;
                for (part, count) in [(0.5, 0), (0.99, 0), (0.9999, 0), (1.0001, 2), (1.01, 2)] {
                    let model = Model::new(tip.clone(), part * alpha, r).unwrap();
                    assert_eq!(unstable_count(&model), Ok(count), "{beta} {r} {part}");
                }
            }
        }
    }

    /// Newton's method, stopped on its way within a rectangle that holds one root, was taken for it.
    #[test]
    fn hundreds_of_roots_are_found_as_counted() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        for alpha in [0.9, 1.2] {
            for count in [80, 100, 300] {
                let model = Model::new(tip.clone(), alpha, 1.0).unwrap();
                let spectrum = leading_roots(&model, count).unwrap();
                assert!(spectrum.roots.len() >= count && spectrum.certificate.is_complete());
            }
        }
    }
}
