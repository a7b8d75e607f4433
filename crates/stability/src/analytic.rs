//! What a characteristic function must tell of itself for its zeros to be found and counted.

use super::StabilityError;
use super::transform::Scaled;
use num_complex::Complex64;

/// h(Λ), analytic right of every line asked for, real on the real axis, λ = rΛ.
pub(super) trait Analytic {
    /// h and h'.
    fn at(&self, lambda: Complex64) -> Scaled;

    /// Σ|terms| of h times e^{-`log_scale`}: what round-off in h is relative to.
    fn size_of_terms(&self, lambda: Complex64, log_scale: f64) -> f64;

    /// λ/Λ
    fn r(&self) -> f64;

    /// A length of the order of the tip's width: h varies over its inverse.
    fn length(&self) -> f64;

    /// Re Λ left of which roots are not looked for: they are those of round-off.
    fn leftmost(&self) -> f64;

    /// Re Λ left of which h is not analytic.
    fn analytic_from(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// All of its zeros lie right of this line, where it has but a few.
    fn left_of_all(&self) -> Option<f64>;

    /// R such that h has no zero with Re Λ ≥ 0 and |Λ| ≥ R.
    fn right_bound(&self) -> f64;

    /// T such that h has no zero with `left` ≤ Re Λ and |Im Λ| ≥ T.
    fn top_bound(&self, left: f64) -> f64;

    /// Where zeros may be, on or above the real axis.
    fn likely_roots(&self) -> Vec<Complex64>;

    /// Numbers out of all proportion.
    fn too_far_apart(&self) -> StabilityError;

    /// |h| over the sum of the sizes of its terms.
    fn relative_residual(&self, lambda: Complex64) -> f64 {
        let h = self.at(lambda);
        h.value.norm() / self.size_of_terms(lambda, h.log_scale)
    }

    /// How far round-off in h displaces a root at Λ: the Newton step, and `roundoff` of its terms / |h'|.
    /// Beside a double root, where h' is small too, no further than h'' allows.
    fn root_error(&self, lambda: Complex64, roundoff: f64) -> f64 {
        let h = self.at(lambda);
        let unknown = h.value.norm() + roundoff * self.size_of_terms(lambda, h.log_scale);
        let error = unknown / h.derivative.norm();
        if error < 1e-9 * lambda.norm() {
            return error;
        }
        let step = 1e-3 / self.length();
        let far = self.at(lambda + step);
        let change = far.derivative * (far.log_scale - h.log_scale).exp() - h.derivative;
        error.min((2.0 * unknown * step / change.norm()).sqrt())
    }
}
