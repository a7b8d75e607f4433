//! Figures along the stability boundary: Fig. 6, and the criticality of the onset.

use super::parts::{Failed, curve, spaced};
use super::tips::figure_of_both;
use stickslip::{FigureDocument, PanelDocument, ScaleName, StyleName};
use stickslip_stability::{Boundary, onset_at};
use stickslip_tip::Wider;

/// Gnecco et al.: k = 1.406 N/(σ v0) is α = r/1.406.
const GNECCO: f64 = 1.0 / 1.406;
const LAST: f64 = 2.0;

/// Fig. 6: the stability boundary in the plane of r and α.
pub(super) fn fig6() -> Result<FigureDocument, Failed> {
    let title = "Fig. 6: α_c(r); steady motion is unstable where shaded";
    let (tips, mut document) = figure_of_both(("fig6", title), |_| Ok(0.0))?;
    document.remarks.push(
        "dashed: the approximate criterion of Gnecco et al. for the triple Gaussian, α = 0.7112 r"
            .into(),
    );
    for tip in &tips {
        let boundary = Boundary::new(&Wider::default(), &tip.function);
        let at = |r: f64| boundary.at(r).ok().map(|at| (r, at.alpha));
        let along = spaced(0.01, LAST, 0.01).into_iter().filter_map(at);
        // αc falls in proportion to r in the end.
        let (r, alpha): (Vec<f64>, Vec<f64>) = std::iter::once((0.0, 0.0)).chain(along).unzip();
        let mut panel = PanelDocument::new(tip.name, ("r", "α"));
        panel.curves.push(curve(StyleName::Boundary, "α_c(r)", &r, &alpha));
        if tip.name == tips[0].name {
            let ends = [0.0, LAST];
            let line = ends.map(|r| GNECCO * r);
            panel.curves.push(curve(StyleName::Dashed, "0.7112 r", &ends, &line));
        }
        let highest = alpha.iter().fold(0.0, |m: f64, a| m.max(*a));
        panel.y_range = Some([0.0, 1.15 * highest]);
        document.panels.push(panel);
    }
    Ok(document)
}

/// log₁₀ of the r shown.
const RANGE: (f64, f64) = (-1.5, 1.0);

/// Criticality along the boundary: small oscillations are stable above it, or unstable below it.
pub(super) fn criticality() -> Result<FigureDocument, Failed> {
    let title = "Criticality along the boundary: supercritical above 0, subcritical below";
    let (tips, mut document) = figure_of_both(("criticality", title), |_| Ok(0.0))?;
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
        let mut panel = PanelDocument::new(tip.name, ("r", "d ln α/d(a²) (σ⁻²)"));
        panel.x_scale = ScaleName::Logarithmic;
        let ends = [RANGE.0, RANGE.1].map(|log| 10f64.powf(log));
        panel.x_range = Some(ends);
        panel.curves.push(curve(StyleName::Dashed, "", &ends, &[0.0; 2]));
        panel.curves.push(curve(StyleName::Line, "", &r, &excess));
        document.panels.push(panel);
    }
    Ok(document)
}
