//! The figure of a run: spring, velocity, surface.

use super::curve::{Curve, Pen};
use super::panel::Panel;
use super::sheet::sheet;
use super::style::LOW;

/// Natural size of the dimensionless quantities: variations far below are round-off.
pub(super) const NATURAL: f64 = 1.0;

/// What a run looked like.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RunFigure<'a> {
    /// Above all panels.
    pub(crate) title: &'a str,
    /// Times.
    pub(crate) t: &'a [f64],
    /// l(t) = r t - r - x0(t).
    pub(crate) l: &'a [f64],
    /// Velocity of the tip at the same times.
    pub(crate) velocity: &'a [f64],
    /// l of the steady state, dashed; left out when not finite.
    pub(crate) steady_l: f64,
    /// Velocity of the support, dashed.
    pub(crate) r: f64,
    /// Abscissas of the surface.
    pub(crate) x: &'a [f64],
    /// The surface at `t_of_surface`.
    pub(crate) u: &'a [f64],
    /// The surface at the start, dotted.
    pub(crate) u_initial: Option<&'a [f64]>,
    /// When the surface is `u`.
    pub(crate) t_of_surface: f64,
}

/// Three panels: l(t), velocity, surface. An SVG document.
pub(crate) fn run(figure: &RunFigure) -> String {
    let ends = ends(figure.t);
    let (steady, r) = ([figure.steady_l; 2], [figure.r; 2]);
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
        surface(figure),
    ];
    sheet(figure.title, &panels)
}

/// A curve against time with a constant, unless that is not finite.
pub(super) fn with_reference<'a>(
    labels: (&'a str, &'a str),
    (t, y, name): (&'a [f64], &'a [f64], String),
    (ends, constant, constant_name): (&'a [f64], &'a [f64], String),
) -> Panel<'a> {
    let mut curves = vec![Curve { x: t, y, pen: Pen::MAIN, label: Some(name) }];
    if constant.iter().all(|c| c.is_finite()) {
        let label = Some(constant_name);
        curves.push(Curve { x: ends, y: constant, pen: Pen::REFERENCE, label });
    }
    Panel::fitted(labels, curves, LOW, NATURAL)
}

fn surface<'a>(figure: &RunFigure<'a>) -> Panel<'a> {
    let label = Some(format!("u(x, t = {})", short(figure.t_of_surface)));
    let now = Curve { x: figure.x, y: figure.u, pen: Pen::MAIN, label };
    let initial = figure.u_initial.map(|initial| {
        let label = Some("at the start".to_owned());
        Curve { x: figure.x, y: initial, pen: Pen::BEFORE, label }
    });
    let curves = initial.into_iter().chain([now]).collect();
    Panel::fitted(("x (σ)", "u (kσ²/a)"), curves, LOW, NATURAL)
}

/// First and last, where a constant line begins and ends.
pub(super) fn ends(values: &[f64]) -> Vec<f64> {
    values.first().into_iter().chain(values.last()).copied().collect()
}

/// At most four decimals, and no zeros behind.
pub(super) fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure<'a>(t: &'a [f64], l: &'a [f64]) -> RunFigure<'a> {
        let title = "test";
        let (u_initial, t_of_surface) = (Some(l), 457.0);
        let (steady_l, r) = (1.07, 1.0);
        RunFigure { title, t, l, velocity: l, steady_l, r, x: t, u: l, u_initial, t_of_surface }
    }

    #[test]
    fn a_hundred_thousand_points_fit_into_300_kilobytes() {
        let t: Vec<f64> = (0..100_000).map(|i| 0.0044 * f64::from(i)).collect();
        let l: Vec<f64> = t.iter().map(|t| t.sin() + 0.3 * (37.0 * t).sin()).collect();
        let svg = run(&figure(&t, &l));
        assert!(svg.len() < 300_000, "{} bytes", svg.len());
    }

    #[test]
    fn the_same_input_gives_the_same_bytes() {
        let (t, l) = ([0.0, 1.0, 2.0], [0.5, 0.7, 0.6]);
        assert_eq!(run(&figure(&t, &l)), run(&figure(&t, &l)));
    }

    #[test]
    fn empty_and_single_samples_are_drawn() {
        assert!(run(&figure(&[], &[])).starts_with("<svg"));
        assert!(run(&figure(&[3.0], &[1.0])).starts_with("<svg"));
    }

    #[test]
    fn values_in_legends_are_short() {
        assert_eq!(short(457.0), "457");
        assert_eq!(short(-1.250_04), "−1.25");
        assert_eq!(short(-1e-9), "0");
    }
}
