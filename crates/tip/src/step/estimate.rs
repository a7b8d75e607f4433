//! Error measures of a step, and limits on its length.

use crate::collocation::{RADAU, STAGES, Stages, apply};

/// Largest displacement of the tip in a step, times the band limit of f: 1.5 widths of a Gaussian. Beyond it the
/// contribution of the step to the groove is not a smooth function of its stages.
const BANDS_PER_STEP: f64 = 13.0;
/// Largest displacement of the tip in a step for any f, in σ.
const LONGEST_DISPLACEMENT: f64 = 4.0;

/// Largest planned displacement of a step, in σ, for an f of this bandwidth.
#[inline]
pub fn longest_displacement(band: f64) -> f64 {
    (BANDS_PER_STEP / band).min(LONGEST_DISPLACEMENT)
}

/// Velocity at the end of a step of length h.
#[inline]
pub fn velocity_at_end(displacement: &Stages, h: f64) -> f64 {
    apply(&RADAU.derivative, displacement)[STAGES - 1] / h
}

/// Defect of the stage polynomial at the start of the step, whose exact velocity is known from the last step.
#[inline]
pub fn defect(displacement: &Stages, h: f64, velocity: f64) -> f64 {
    let slope: f64 = RADAU.derivative_at_start.iter().zip(displacement).map(|(w, d)| w * d).sum();
    slope / h - velocity
}

/// Error of the stage polynomial as an interpolant, from its extrapolation back into the last step, whose
/// displacements and length are given.
#[inline]
pub fn interpolation_error(
    displacement: &Stages,
    h: f64,
    (before, h_before): (&Stages, f64),
) -> f64 {
    let [.., last, end] = *before;
    let tau = (RADAU.c[STAGES - 2] - 1.0) * h_before / h;
    RADAU.interpolation_error(displacement, tau, last - end)
}

/// The largest rate, in k/Γ, at which a tip relaxes against this stiffness.
pub(crate) fn fastest(stiffness: f64, inertia: Option<f64>) -> f64 {
    let Some(mass) = inertia else { return stiffness };
    let damped = 1.0 - 4.0 * mass * stiffness;
    if damped > 0.0 { (1.0 + damped.sqrt()) / (2.0 * mass) } else { (stiffness / mass).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two steps of one polynomial: of degree s, which a step reproduces, and one higher.
    #[test]
    fn a_step_of_a_polynomial_of_degree_s_has_no_error_and_one_of_higher_degree_has() {
        let signs = |degree: usize| {
            let degree = i32::try_from(degree).unwrap();
            let x = |t: f64| t - 0.3 * t.powi(degree);
            let velocity = |t: f64| 1.0 - 0.3 * f64::from(degree) * t.powi(degree - 1);
            let (start, middle, end) = (0.2, 0.9, 1.4);
            let step = |from: f64, to: f64| RADAU.c.map(|c| x(from + c * (to - from)) - x(from));
            let (before, now) = (step(start, middle), step(middle, end));
            let (h_before, h) = (middle - start, end - middle);
            assert_eq!(
                degree > 6,
                (velocity_at_end(&before, h_before) - velocity(middle)).abs() > 1e-9
            );
            let defect = defect(&now, h, velocity(middle));
            (defect.abs(), interpolation_error(&now, h, (&before, h_before)))
        };
        let (exact, higher) = (signs(STAGES), signs(STAGES + 1));
        assert!(exact.0 < 1e-12 && exact.1 < 1e-14, "{exact:?}");
        assert!(higher.0 > 1e-6 && higher.1 > 1e-7, "{higher:?}");
    }
}
