//! Fig. 4: the surface after the Gaussian tip, and its initial surface.

use super::parts::{curve, failed, figure as empty, finished, heights, panel, spaced};
use super::tips::{BETA_0, beta_0};
use crate::failed::Failed;
use std::sync::LazyLock;
use stickslip::{FigureDocument, StyleName};
use stickslip_tip::{Noise, Run, Scenario};

pub(super) const END: f64 = 460.0;
/// The paper's noise with its grid, from which the motion grows.
const NOISE: Noise = Noise { amplitude: 1e-4, spacing: 0.001, seed: 1 };

/// The run of Figs. 4 and 7, computed once.
pub(super) fn settled() -> Result<&'static (Scenario, Run), Failed> {
    static SETTLED: LazyLock<Result<(Scenario, Run), Failed>> = LazyLock::new(compute);
    SETTLED.as_ref().map_err(|failure| failed("Fig. 4", failure))
}

fn compute() -> Result<(Scenario, Run), Failed> {
    let tip = beta_0()?;
    let model = tip.model(tip.critical(1.0)?.alpha + 0.03, 1.0)?;
    // The noise is rough: every spacing is a step, and more digits than these mean nothing.
    let scenario = Scenario { noise: Some(NOISE), tolerance: 1e-6, ..Scenario::new(model, END) };
    let run = finished(&scenario)?;
    Ok((scenario, run))
}

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let (scenario, run) = settled()?;
    let x = spaced(0.0, 470.0, 0.1);
    let title = "Fig. 4: surface, f = exp(−x²), r = 1, α = α_c + 0.03";
    let mut document = empty("fig4", title, std::slice::from_ref(&scenario.model));
    document.remarks = vec![
        BETA_0.into(),
        "t = 460 of the caption; the text says 954 (docs/findings/corrections.md, 12)".into(),
        "steady start with noise of 1e-4 on the paper's grid of 0.001; the grid is part of such a start, as \
         is the seed (docs/findings/corrections.md, 10)"
            .into(),
    ];
    let mut panel = panel("", ("x (σ)", "u (kσ²/a)"));
    let start = run.trajectory.start();
    panel.curves = vec![
        curve(StyleName::Line, "u(x, t = 460)", &x, &heights(scenario, run, END, &x)?),
        curve(StyleName::Dotted, "u(x, t₁)", &x, &heights(scenario, run, start, &x)?),
    ];
    document.panels.push(panel);
    Ok(document)
}
