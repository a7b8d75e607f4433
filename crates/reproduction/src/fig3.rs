//! Fig. 3: the wavelength against α - αc.

use super::fig2::distances;
use super::onset::{FITTED, Onset};
use super::parts::{curve, figure as empty, panel};
use super::tips::{BETA_0, beta_0, beta_1};
use crate::failed::Failed;
use stickslip::{FigureDocument, StyleName};

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let tips = [beta_1()?, beta_0()?];
    let critical = [tips[0].critical(1.0)?, tips[1].critical(1.0)?];
    let models = [tips[0].model(critical[0].alpha, 1.0)?, tips[1].model(critical[1].alpha, 1.0)?];
    let mut document = empty("fig3", "Fig. 3: wavelength of the surface, r = 1", &models);
    document.remarks.push(BETA_0.into());
    for (tip, at) in tips.iter().zip(critical) {
        let found = Onset::above(tip, &distances())?;
        let (intercept, slope) = found.fit(&found.wavelength);
        let ends = [0.0, found.distance[found.distance.len() - 1]];
        let heading = format!("{}, α_c = {:.3}, 2πr/ω = {:.4}", tip.name, at.alpha, at.wavelength);
        let mut panel = panel(&heading, ("α − α_c", "L (σ)"));
        panel.curves = vec![
            curve(StyleName::Dots, "L", &found.distance, &found.wavelength),
            curve(
                StyleName::Line,
                &format!("fit to the first {FITTED}"),
                &ends,
                &ends.map(|x| intercept + slope * x),
            ),
            curve(StyleName::Triangles, "2πr/ω at α_c", &[0.0], &[at.wavelength]),
        ];
        document.panels.push(panel);
    }
    Ok(document)
}
