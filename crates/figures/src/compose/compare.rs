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
        let lag = |x0: &[f64]| -> Vec<f64> {
            self.t.iter().zip(x0).map(|(t, x)| model.r * t - x).collect()
        };
        let (closed, grid) = (lag(&self.closed.x0), lag(&self.grid.x0));
        let motions = |labels, closed: &[f64], grid: &[f64]| {
            let curves = vec![
                CurveDocument::new(StyleName::Line, "closed equation", &self.t, closed),
                CurveDocument::new(StyleName::Dashed, "grid", &self.t, grid),
            ];
            PanelDocument::of_curves(labels, curves)
        };
        let apart = |labels, x: &Vec<f64>, a: &Vec<f64>, b: &Vec<f64>| {
            differences(labels, [[&**x, a, b]].into_iter())
        };
        let mut panels = vec![
            motions((LAG.0, LAG_OF_STEADY_SUPPORT), &closed, &grid),
            apart(("t (Γ/k)", "|Δx₀| (σ)"), &self.t, &self.closed.x0, &self.grid.x0),
            apart(("x (σ)", "|Δu| (kσ²/a)"), &self.x, &self.closed.u, &self.grid.u),
        ];
        if let (Some(closed), Some(grid)) = (&self.closed.y0, &self.grid.y0) {
            panels.insert(1, motions(("t (Γ/k)", "y₀(t) (σ)"), closed, grid));
            panels.insert(3, apart(("t (Γ/k)", "|Δy₀| (σ)"), &self.t, closed, grid));
        }
        Ok(FigureDocument::new("compare", &title, vec![model.clone()], panels))
    }
}
