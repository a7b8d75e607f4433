//! What axes are called, and where an axis becomes one of decades.

/// r, (12).
pub(super) const R: &str = "r = Γv₀/(kσ)";
/// α, (13).
pub(super) const ALPHA: &str = "α = ΓNa/(k²σ²)";
/// Of the spring.
pub(super) const L: (&str, &str) = ("t (Γ/k)", "l = rt − r − x₀ (σ)");
/// Of the tip.
pub(super) const VELOCITY: (&str, &str) = ("t (Γ/k)", "ẋ₀ (kσ/Γ)");
/// Of a spring whose end moves on a path: the lateral force.
pub(super) const LAG: (&str, &str) = ("t (Γ/k)", "R − x₀ (σ)");
/// Of a tip without a spring.
pub(super) const POSITION: (&str, &str) = ("t (Γ/k)", "x₀ (σ)");
/// Of the support.
pub(super) const WAY: &str = "R (σ)";
/// Of what pushes it.
pub(super) const FORCE: (&str, &str) = ("t (Γ/k)", "F_{ext} (kσ)");
/// Of the surface.
pub(super) const SURFACE: (&str, &str) = ("x (σ)", "u (kσ²/a)");

/// Natural size of the dimensionless quantities: variations far below are round-off.
pub(super) const NATURAL: Option<f64> = Some(1.0);

/// Values that span more than this ratio are drawn on a logarithmic axis.
pub(super) const WIDE: f64 = 30.0;
