//! The kernel: a formula, its bandwidth and its reach.

/// A real kernel `K(ξ)` of the separation `ξ = x − y`, target minus source.
///
/// The caller guarantees bandwidth and reach; the accuracy of every sum depends on them. For the Gaussian
/// `exp(−ξ²/2σ²)` and its first derivatives, `band = 8.7/σ` and `reach = 8.7σ` are sufficient.
#[derive(Clone, Copy)]
pub struct Kernel<'a> {
    /// The formula; finite for every finite separation.
    pub value: &'a (dyn Fn(f64) -> f64 + Sync),
    /// The wavenumber (radians per unit length) beyond which the transform of `K` is below
    /// round-off. Positive.
    pub band: f64,
    /// The distance beyond which `|K|` is below round-off, or `None` if there is none, as for the Bessel functions
    /// `J0` and `J1`; such a kernel is tapered beyond the separations in use, and must only be bounded.
    pub reach: Option<f64>,
}
