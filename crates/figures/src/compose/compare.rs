//! Figure of a comparison: both motions, and their difference.

use super::axes::{LAG, LAG_OF_STEADY_SUPPORT, differences};
use super::drawn::{Drawn, View};
use super::tip::model_name;
use crate::error::FigureError;
use stickslip::{CompareDocument, CurveDocument, FigureDocument, PanelDocument, StyleName};

impl Drawn for CompareDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let model = &self.parameters.run.model_parameters();
        let title = format!("Closed equation and grid, {}", model_name(model));
        let mut figure = FigureDocument::new("compare", &title, vec![model.clone()]);
        let lag = |x0: &[f64]| -> Vec<f64> {
            self.t.iter().zip(x0).map(|(t, x)| model.r * t - x).collect()
        };
        let (closed, grid) = (lag(&self.closed.x0), lag(&self.grid.x0));
        let mut motions = PanelDocument::new("", (LAG.0, LAG_OF_STEADY_SUPPORT));
        let curves = |closed: &[f64], grid: &[f64]| {
            vec![
                CurveDocument::new(StyleName::Line, "closed equation", &self.t, closed),
                CurveDocument::new(StyleName::Dashed, "grid", &self.t, grid),
            ]
        };
        motions.curves = curves(&closed, &grid);
        let apart = |labels, x: &Vec<f64>, a: &Vec<f64>, b: &Vec<f64>| {
            differences(labels, [[&**x, a, b]].into_iter())
        };
        figure.panels = vec![
            motions,
            apart(("t (Γ/k)", "|Δx₀| (σ)"), &self.t, &self.closed.x0, &self.grid.x0),
            apart(("x (σ)", "|Δu| (kσ²/a)"), &self.x, &self.closed.u, &self.grid.u),
        ];
        if let (Some(closed), Some(grid)) = (&self.closed.y0, &self.grid.y0) {
            let mut across = PanelDocument::new("", ("t (Γ/k)", "y₀(t) (σ)"));
            across.curves = curves(closed, grid);
            let difference = apart(("t (Γ/k)", "|Δy₀| (σ)"), &self.t, closed, grid);
            figure.panels.splice(1..1, [across]);
            figure.panels.splice(3..3, [difference]);
        }
        Ok(figure)
    }
}
