//! The figure of a limit cycle: spring, velocity, the ripple left behind.

use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::run::{NATURAL, ends, short, with_reference};
use super::sheet::sheet;
use super::style::LOW;

/// What a cycle looks like. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CycleFigure<'a> {
    /// Above all panels.
    pub(crate) title: &'a str,
    /// Times.
    pub(crate) t: &'a [f64],
    /// l(t) = r t - r - x0(t).
    pub(crate) l: &'a [f64],
    /// Velocity of the tip at the same times.
    pub(crate) velocity: &'a [f64],
    /// l of the steady state, dashed.
    pub(crate) steady_l: f64,
    /// Velocity of the support, dashed.
    pub(crate) r: f64,
    /// Abscissas of the surface far behind.
    pub(crate) x: &'a [f64],
    /// The surface there.
    pub(crate) u: &'a [f64],
}

/// Three panels: l(t), velocity, surface. An SVG document.
pub(crate) fn cycle(figure: &CycleFigure) -> String {
    let ends = ends(figure.t);
    let (steady, r) = ([figure.steady_l; 2], [figure.r; 2]);
    let label = Some("u far behind the tip".to_owned());
    let behind = Curve { x: figure.x, y: figure.u, pen: Pen::MAIN, label };
    let panels = [
        with_reference(
            ("t (Γ/k)", "l = rt − r − x₀ (σ)"),
            (figure.t, figure.l, "l(t)".to_owned()),
            (&ends, &steady, format!("steady state, l₀ = {}", short(figure.steady_l))),
        ),
        with_reference(
            ("t (Γ/k)", "ẋ₀ (kσ/Γ)"),
            (figure.t, figure.velocity, "ẋ₀(t)".to_owned()),
            (&ends, &r, format!("support, r = {}", short(figure.r))),
        ),
        Panel::fitted(("x (σ)", "u (kσ²/a)"), vec![behind], LOW, NATURAL),
    ];
    sheet(figure.title, &panels)
}
