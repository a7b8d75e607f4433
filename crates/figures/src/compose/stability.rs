//! Figure of growth exponents in the complex plane.

use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use super::tip::{model_name, stiffness_name};
use crate::axis::extremes;
use crate::error::FigureError;
use stickslip::{
    ColourName, ComplexDocument, CurveDocument, FigureDocument, PanelDocument, StabilityDocument,
    StyleName, WalkDocument, WalkingDocument,
};

/// Smallest width of the unstable part of the plane, relative to that of the stable part.
const UNSTABLE_PART: f64 = 0.15;
const PADDING: f64 = 0.06;

impl Drawn for StabilityDocument {
    /// Growth exponents of the motion along the scan. Those of the critical point are drawn on the imaginary axis, without
    /// their round-off.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let model = self.parameters.model_parameters();
        let snaking = self.snaking.as_ref().and_then(Option::as_ref);
        let what = match (self.parameters.at_critical_point, self.stable) {
            _ if snaking.is_some_and(|at| model.alpha >= at.alpha) => "snakes",
            (true, _) => "critical",
            (_, true) => "stable",
            (_, false) => "unstable",
        };
        let across = stiffness_name(self.parameters.stiffness_across);
        let title = format!("{}{across}: {what}", model_name(&model));
        let name = if self.snaking.is_some() { "along the scan" } else { "" };
        let panels = vec![exponents(name, &self.roots, self.certificate.largest_error)];
        Ok(FigureDocument::new("stability", &title, vec![model], panels))
    }
}

/// A panel of growth exponents with this error.
pub(super) fn exponents(name: &str, roots: &[ComplexDocument], error: f64) -> PanelDocument {
    let mut panel = PanelDocument::new(name, ("Re λ (k/Γ)", "Im λ (k/Γ)"));
    let (x, y) = axes(roots);
    panel.x_range = Some(x);
    panel.y_range = Some(y);
    panel.shades = vec![[0.0, x[1]]];
    let zero = [0.0; 2];
    panel.curves = vec![
        CurveDocument::new(StyleName::Thin, "", &zero, &y),
        CurveDocument::new(StyleName::Thin, "", &x, &zero),
        dots(roots, "decaying", ColourName::Blue, |re| re < -error),
        dots(roots, "growing", ColourName::Vermillion, |re| re > error),
        dots(roots, "neither", ColourName::Black, |re| re.abs() <= error),
    ];
    panel
}

/// The roots in a part of the plane, with their complex conjugates.
fn dots(
    roots: &[ComplexDocument],
    name: &str,
    colour: ColourName,
    wanted: impl Fn(f64) -> bool,
) -> CurveDocument {
    let here = roots.iter().filter(|root| wanted(root.re));
    let (x, y): (Vec<f64>, Vec<f64>) = here.map(|root| (root.re, root.im)).unzip();
    CurveDocument::new(StyleName::Dots, name, &x, &y).coloured(colour)
}

/// Ranges of both axes, which include the origin, and some of the unstable half-plane.
fn axes(roots: &[ComplexDocument]) -> ([f64; 2], [f64; 2]) {
    let of = |part: fn(&ComplexDocument) -> f64| {
        let values = roots.iter().map(part).filter(|v| v.is_finite());
        let (low, high) = extremes(values.chain([0.0])).unwrap_or((0.0, 0.0));
        let span = if high > low { high - low } else { 1.0 };
        [low - PADDING * span, high + PADDING * span]
    };
    let (x, y) = (of(|root| root.re), of(|root| root.im));
    ([x[0], x[1].max(-UNSTABLE_PART * x[0])], y)
}

impl Drawn for WalkingDocument {
    /// A panel for each walk.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        if self.walks.is_empty() {
            return Err(FigureError::Nothing("there is no steady walk to draw".into()));
        }
        let model = &self.parameters.model_parameters();
        let title = format!("Steady walks, {}", model_name(model));
        let panel = |walk: &WalkDocument| {
            let speed = Quantity::new(walk.speed, "kσ/Γ").in_text(&format!("{:.6}", walk.speed));
            let name = format!("v = {speed}: {}", walk.stability());
            exponents(&name, &walk.roots, walk.certificate.largest_error)
        };
        let panels = self.walks.iter().map(panel).collect();
        Ok(FigureDocument::new("walking", &title, vec![model.clone()], panels))
    }
}
