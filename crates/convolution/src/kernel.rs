//! What is summed: a formula and the two numbers that say how far it goes.

use std::fmt;

/// A real kernel `K(ξ)` of the separation `ξ = x − y`, target minus source.
///
/// The two numbers are the caller's promise; the accuracy of every sum rests on them. For the
/// Gaussian `exp(−ξ²/2σ²)` and its first derivatives, `band = 8.7/σ` and `reach = 8.7σ` do.
#[derive(Clone, Copy)]
pub struct Kernel<'a> {
    /// The formula. Finite for every finite separation.
    pub value: &'a (dyn Fn(f64) -> f64 + Sync),
    /// The wavenumber (radians per unit length) beyond which the transform of `K` is below
    /// round-off. Positive.
    pub band: f64,
    /// The distance beyond which `|K|` is below round-off, or `None` if it never is, as for the
    /// Bessel functions `J0` and `J1`; such a kernel is tapered beyond the separations in use, and
    /// needs only to stay bounded.
    pub reach: Option<f64>,
}

impl fmt::Debug for Kernel<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Kernel")
            .field("band", &self.band)
            .field("reach", &self.reach)
            .finish_non_exhaustive()
    }
}
