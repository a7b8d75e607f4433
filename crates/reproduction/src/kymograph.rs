//! u against position and time: the tip sticks, digs, and slips out of its pit.

use super::parts::{figure as empty, finished, heights, panel, spaced};
use super::tips::beta_1;
use crate::failed::Failed;
use stickslip::{ColoursName, FigureDocument, MapDocument};
use stickslip_tip::Scenario;

const ALPHA: f64 = 1.4;
const TIMES: (f64, f64) = (260.0, 300.0);

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let model = beta_1()?.model(ALPHA, 1.0)?;
    let scenario = Scenario { kick: 0.1, ..Scenario::new(model, TIMES.1) };
    let run = finished(&scenario)?;
    let x = spaced(TIMES.0 - 10.0, TIMES.1 + 5.0, 0.1);
    let t = spaced(TIMES.0, TIMES.1, 0.2);
    let z: Vec<Vec<f64>> =
        t.iter().map(|t| heights(&scenario, &run, *t, &x)).collect::<Result<_, _>>()?;
    let title = "Kymograph: u(x, t), β = 1, r = 1, α = 1.4";
    let mut document = empty("kymograph", title, std::slice::from_ref(&scenario.model));
    let mut panel = panel("", ("x (σ)", "t (Γ/k)"));
    let z_label = "u (kσ²/a)".into();
    panel.map =
        Some(MapDocument { x, y: t, z, z_label, colours: ColoursName::BlueRed, z_range: None });
    document.panels.push(panel);
    Ok(document)
}
