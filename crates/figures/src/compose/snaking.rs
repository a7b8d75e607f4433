//! Figure of the threshold of snaking.

use super::axes::R;
use super::drawn::{Drawn, View};
use super::tip::{terms_name, tip_name};
use crate::error::FigureError;
use crate::number::short;
use stickslip::{
    ColourName, CurveDocument, FigureDocument, PanelDocument, SnakingBoundaryDocument, StyleName,
};

/// Space above the lower of both thresholds, as a factor of its largest value.
const AIR: f64 = 1.5;

impl Drawn for SnakingBoundaryDocument {
    /// The critical α of snaking and of stick-slip, and the wavelength of snaking at its threshold.
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        if self.alpha.is_empty() {
            let message = "no scan line snakes at any of these values, whatever α";
            return Err(FigureError::Nothing(message.into()));
        }
        let parameters = &self.parameters;
        let over_stiffness = parameters.stiffness_range.is_some();
        let (x, label) = if over_stiffness { (&self.stiffness, "κ_y") } else { (&self.r, R) };
        let held = [
            (", r = ", parameters.r.filter(|_| over_stiffness)),
            (", κ_y = ", parameters.stiffness_across.filter(|_| !over_stiffness)),
        ];
        let held =
            held.iter().filter_map(|(name, value)| value.map(|v| format!("{name}{}", short(v))));
        let title = format!(
            "{}{}{}",
            tip_name(&(&parameters.tip.0).into()),
            held.collect::<String>(),
            terms_name(&parameters.law)
        );
        let snaking = CurveDocument::new(StyleName::Line, "snaking", x, &self.alpha);
        let snaking = vec![snaking.coloured(ColourName::Green)];
        let mut threshold = PanelDocument::of_curves((label, "critical α"), snaking);
        if self.alpha_stick_slip.iter().any(Option::is_some) {
            let alpha = self.alpha_stick_slip.clone();
            let stick_slip = CurveDocument::with_gaps(StyleName::Line, "stick-slip", x, alpha);
            threshold.curves.push(stick_slip.coloured(ColourName::Blue));
            let lower = self.alpha.iter().zip(&self.alpha_stick_slip);
            let lower = lower.map(|(a, b)| b.map_or(*a, |b| a.min(b))).fold(0.0, f64::max);
            threshold.y_range = (lower > 0.0).then_some([0.0, AIR * lower]);
        }
        let along = CurveDocument::new(StyleName::Line, "", x, &self.wavelength);
        let along = vec![along.coloured(ColourName::Green)];
        let wavelength = PanelDocument::of_curves((label, "wavelength of snaking (σ)"), along);
        Ok(FigureDocument::new("snaking-boundary", &title, vec![], vec![threshold, wavelength]))
    }
}
