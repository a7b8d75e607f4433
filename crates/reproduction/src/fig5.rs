//! Fig. 5: squares of the amplitudes of u and x0 against r - rc.

use super::fig2::amplitudes;
use super::onset::Onset;
use super::parts::{figure as empty, spaced};
use super::tips::beta_1;
use crate::failed::Failed;
use stickslip::FigureDocument;

const ALPHA: f64 = 1.0;
const STEADY: [f64; 2] = [0.01, 0.02];

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let tip = beta_1()?;
    let critical = tip.critical_r(ALPHA)?;
    let title = "Fig. 5: squared amplitudes of the surface and of the tip, α = 1";
    let mut document = empty("fig5", title, &[tip.model(ALPHA, critical.r)?]);
    document.remarks.push(
        "the paper quotes 6.59 as the period at r → rc; it is the wavelength there, the period is 6.87 \
         (docs/findings/corrections.md, 5)"
            .into(),
    );
    let distances: Vec<f64> = spaced(0.01, 0.1, 0.01).iter().map(|d| -d).collect();
    let found = Onset::along(&distances, |distance| tip.model(ALPHA, critical.r + distance))?;
    let heading = format!("{}, r_c = {:.4}", tip.name, critical.r);
    document.panels.push(amplitudes(&heading, "r − r_c", &found, &STEADY));
    Ok(document)
}
