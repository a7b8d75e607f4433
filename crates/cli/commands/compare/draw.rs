//! Both motions, and how far apart they are.

use crate::failure::Failure;
use crate::plot::{self, DrawnCurve, DrawnPanel, Style, seven_digits};
use stickslip_documents::CompareDocument;

/// An SVG document.
pub(super) fn draw(document: &CompareDocument) -> Result<String, Failure> {
    let CompareDocument { t, x, closed, grid, .. } = document;
    let model = &document.parameters.model;
    let [alpha, r] = [model.alpha, model.r].map(seven_digits);
    let lag = |x0: &[f64]| -> Vec<f64> { t.iter().zip(x0).map(|(t, x)| model.r * t - x).collect() };
    let lags = [lag(&closed.x0), lag(&grid.x0)];
    let apart = [apart(&closed.x0, &grid.x0), apart(&closed.u, &grid.u)];
    let curve = |name, style, x, y| DrawnCurve { name, style, x, y };
    let motions = vec![
        curve(Some("closed equation"), Style::Line, t, &lags[0]),
        curve(Some("grid"), Style::Dashed, t, &lags[1]),
    ];
    let panels = [
        panel(("t (Γ/k)", "r t − x₀ (σ)"), motions),
        panel(("t (Γ/k)", "log₁₀ |Δx₀| (σ)"), vec![curve(None, Style::Line, t, &apart[0])]),
        panel(("x (σ)", "log₁₀ |Δu| (kσ²/a)"), vec![curve(None, Style::Line, x, &apart[1])]),
    ];
    plot::drawing(&format!("Closed equation and grid, α = {alpha}, r = {r}"), &panels)
        .map_err(|error| Failure::Run(format!("cannot draw: {error}")))
}

fn panel<'a>(labels: (&'a str, &'a str), curves: Vec<DrawnCurve<'a>>) -> DrawnPanel<'a> {
    DrawnPanel { heading: "", labels, curves, map: None, y_range: None }
}

/// log₁₀ of the differences; equal values, which have none, are not drawn.
fn apart(a: &[f64], b: &[f64]) -> Vec<f64> {
    let log = |difference: f64| if difference > 0.0 { difference.log10() } else { f64::NAN };
    a.iter().zip(b).map(|(a, b)| log((a - b).abs())).collect()
}
