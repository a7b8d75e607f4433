//! Figure of the growth exponents of steady walks, in the complex plane.

use super::drawn::{Drawn, View};
use super::quantity::Quantity;
use super::stability::exponents;
use super::tip::model_name;
use crate::error::FigureError;
use stickslip::{FigureDocument, WalkDocument, WalkingDocument};

impl Drawn for WalkingDocument {
    /// A panel for each walk.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        if self.walks.is_empty() {
            return Err(FigureError::Nothing("there is no steady walk to draw".into()));
        }
        let model = &self.parameters.model_parameters();
        let title = format!("Steady walks, {}", model_name(model));
        let mut figure = FigureDocument::new("walking", &title, vec![model.clone()]);
        let panel = |walk: &WalkDocument| {
            let state = if walk.stable { "stable" } else { "unstable" };
            let name = format!(
                "v = {}: {state}",
                Quantity::new(walk.speed, "kσ/Γ").said(&format!("{:.6}", walk.speed))
            );
            exponents(&name, &walk.roots, walk.certificate.largest_error)
        };
        figure.panels = self.walks.iter().map(panel).collect();
        Ok(figure)
    }
}
