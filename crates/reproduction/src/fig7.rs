//! Fig. 7: the surface of Fig. 4 in three dimensions, (60).

use super::fig4::{END, settled};
use super::parts::{failed, figure as empty, panel, spaced};
use super::tips::BETA_0;
use crate::failed::Failed;
use stickslip::{ColoursName, FigureDocument, MapDocument};
use stickslip_surface::Surface;
use stickslip_tip::Footprint;

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let (scenario, run) = settled()?;
    let (x, y) = (spaced(400.0, 450.0, 0.1), spaced(-2.0, 2.0, 0.05));
    // h of (60), whatever the width of f.
    let footprint = Footprint::separable(scenario.model.tip().clone(), 1.0)
        .map_err(|error| failed("the tip", &error))?;
    let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
    let image =
        surface.image(&footprint, END, &x, &y).map_err(|error| failed("the surface", &error))?;
    let z = image.rows().into_iter().map(|row| row.to_vec()).collect();
    let title = "Fig. 7: u(x, y, t = 460), f = exp(−x²), r = 1, α = α_c + 0.03";
    let mut document = empty("fig7", title, std::slice::from_ref(&scenario.model));
    document.remarks = vec![
        BETA_0.into(),
        "h(y) = exp(-y²/2) as printed in (60); the round tip that goes with exp(-x²) would have exp(-y²)"
            .into(),
    ];
    let mut panel = panel("", ("x (σ)", "y (σ)"));
    let z_label = "u (kσ²/a)".into();
    panel.map = Some(MapDocument { x, y, z, z_label, colours: ColoursName::Grey, z_range: None });
    document.panels.push(panel);
    Ok(document)
}
