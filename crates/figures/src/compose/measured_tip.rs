//! Figure of a measured footprint: data, fit, and residuals.

use super::axes::{after_number, evenly, labelled, residual};
use super::drawn::{Drawn, View};
use crate::error::FigureError;
use crate::number::{plus_minus, short};
use stickslip::{
    ColourName, CurveDocument, EstimateDocument, FigureDocument, Gaussian, MeasuredTipDocument,
    ModelParameters, PanelDocument, StyleName, TipDocument,
};

/// Number of points of the fitted curve.
const POINTS: u32 = 600;

impl Drawn for MeasuredTipDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        let (x, unit) = (&self.profile.x, self.parameters.unit.as_deref());
        let (Some(first), Some(last)) = (x.first(), x.last()) else {
            return Err(FigureError::Nothing("the profile has no rows".into()));
        };
        let title = format!(
            "A tip of {} Gaussian{}: σ = {}{}, α_c = {} at r = {}",
            self.terms,
            if self.terms == 1 { "" } else { "s" },
            with_error(&self.sigma),
            after_number(unit),
            with_error(&self.critical_alpha),
            short(self.parameters.r),
        );
        let tip = TipDocument::Gaussians { gaussians: self.gaussians.clone() };
        let alpha = self.critical_alpha.value;
        let model = ModelParameters::papers(tip, alpha, None, self.parameters.r);
        let x_label = labelled("x", unit);
        let along: Vec<f64> = evenly([*first, *last], POINTS).collect();
        let ground: Vec<f64> = along.iter().map(|x| self.ground(*x)).collect();
        let fit: Vec<f64> = along.iter().map(|x| height(self, *x)).collect();
        let height_label = labelled("height", self.parameters.height_unit.as_deref());
        let measured = CurveDocument::new(StyleName::Points, "as measured", x, &self.profile.f);
        let data = vec![
            measured.coloured(ColourName::Grey),
            CurveDocument::new(StyleName::Dashed, "ground", &along, &ground),
            CurveDocument::new(StyleName::Line, "fit", &along, &fit),
        ];
        let difference = residual("fit", self.parameters.height_unit.as_deref());
        let [low, high] = [-self.noise, self.noise].map(|noise| [noise; 2]);
        let noise = CurveDocument::band("noise from row to row", &[*first, *last], &low, &high);
        let rest = vec![
            noise.coloured(ColourName::Silver),
            CurveDocument::new(StyleName::Points, "", x, &self.profile.residuals()),
        ];
        let panels = vec![
            PanelDocument::of_curves((&x_label, &height_label), data),
            PanelDocument::of_curves((&x_label, &difference), rest),
        ];
        let figure = FigureDocument::new("tip", &title, vec![model], panels);
        Ok(FigureDocument { remarks: self.remarks.clone(), ..figure })
    }
}

/// Height of background and footprint at a position.
fn height(tip: &MeasuredTipDocument, x: f64) -> f64 {
    let y = (x - tip.centre) / tip.sigma.value;
    let term = |g: &Gaussian| {
        let z = (y - g.center) / g.width;
        g.amplitude * (-0.5 * z * z).exp()
    };
    let f: f64 = tip.gaussians.iter().map(term).sum();
    tip.ground(x) + tip.apex * f
}

/// Relative half width of an interval below which the interval is round-off.
const ROUND_OFF: f64 = 1e-12;

/// A value with its error, such as "1.88 ± 0.02".
pub(super) fn with_error(estimate: &EstimateDocument) -> String {
    let (Some(low), Some(high)) = (estimate.low, estimate.high) else {
        return short(estimate.value);
    };
    let half = 0.5 * (high - low);
    // Data without noise have intervals of round-off.
    if half <= ROUND_OFF * estimate.value.abs() {
        return short(estimate.value);
    }
    plus_minus(estimate.value, half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_of_round_off_is_no_error() {
        let said = |half: f64| {
            let value = 5.0025;
            with_error(&EstimateDocument {
                value,
                low: Some(value - half),
                high: Some(value + half),
            })
        };
        assert_eq!([said(0.02), said(1e-15), said(0.0)], ["5.003 ± 0.020", "5.0025", "5.0025"]);
    }
}
