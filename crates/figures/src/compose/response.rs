//! Figure of the linear response to weak pulses.

use super::drawn::{Drawn, View};
use super::tip::model_name;
use crate::error::FigureError;
use stickslip::{CurveDocument, FigureDocument, PanelDocument, ResponseDocument, StyleName};

/// Half of the time for which a pulse is drawn, in widths of the pulse.
const WIDTHS: f64 = 5.0;

impl Drawn for ResponseDocument {
    /// The deviation, with the time range shaded in which the listed modes are insufficient.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let model = &self.parameters.model_parameters();
        let title = format!("Linear response, {}", model_name(model));
        let t = &self.samples.t;
        let deviation = self.samples.deviation.clone();
        let curve = CurveDocument::with_gaps(StyleName::Line, "", t, deviation);
        let mut panel = PanelDocument::of_curves(("t (Γ/k)", "l − l₀ (σ)"), vec![curve]);
        if let (Some(first), Some(last)) = (t.first().copied(), t.last().copied()) {
            let begins = self.parameters.pulses.iter().map(|p| p.time - WIDTHS * p.width);
            let from = begins.fold(self.origin, f64::min).max(first);
            let to = self.valid_from.min(last);
            if from < to {
                panel.shades.push([from, to]);
                let modes = self.modes.len();
                panel.heading = format!("on the shaded background {modes} modes are not enough");
            }
        }
        Ok(FigureDocument::new("response", &title, vec![model.clone()], vec![panel]))
    }
}
