//! The small oscillation along the boundary: stable above it, or unstable below.

use super::parts::{curve, figure as empty, panel, spaced};
use super::tips::{BETA_0, beta_0, beta_1};
use crate::failed::Failed;
use stickslip::{FigureDocument, ScaleName, StyleName};
use stickslip_stability::{Boundary, onset_at};
use stickslip_tip::Wider;

/// log₁₀ of the r shown.
const RANGE: (f64, f64) = (-1.5, 1.0);

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let tips = [beta_1()?, beta_0()?];
    let models = [tips[0].model(0.0, 1.0)?, tips[1].model(0.0, 1.0)?];
    let title = "Criticality along the boundary: supercritical above 0, subcritical below";
    let mut document = empty("criticality", title, &models);
    document.remarks.push(BETA_0.into());
    document.remarks.push(
        "d ln α/d(a²), a half the peak-to-peak of x0: the excess over αc, in parts of it, for an amplitude \
         of 1, to leading order"
            .into(),
    );
    for tip in &tips {
        let boundary = Boundary::new(&Wider::default(), &tip.function);
        let excess = |log: f64| {
            let r = 10f64.powf(log);
            let at = boundary.at(r).ok()?;
            let slope = onset_at(&tip.function, at).ok()?.amplitude_squared_slope;
            Some((r, 1.0 / (slope * at.alpha)))
        };
        let found: Vec<(f64, f64)> =
            spaced(RANGE.0, RANGE.1, 0.01).into_iter().filter_map(excess).collect();
        let (r, excess): (Vec<f64>, Vec<f64>) = found.into_iter().unzip();
        let mut panel = panel(tip.name, ("r", "d ln α/d(a²) (σ⁻²)"));
        panel.x_scale = ScaleName::Logarithmic;
        let ends = [RANGE.0, RANGE.1].map(|log| 10f64.powf(log));
        panel.x_range = Some(ends);
        panel.curves.push(curve(StyleName::Dashed, "", &ends, &[0.0; 2]));
        panel.curves.push(curve(StyleName::Line, "", &r, &excess));
        document.panels.push(panel);
    }
    Ok(document)
}
