//! Fig. 1: the surface at t = 457 below and above onset, and the tip's velocity above.

use super::parts::{Failed, curve, figure as figure_with, finished, heights, spaced};
use super::tips::beta_1;
use stickslip::{FigureDocument, PanelDocument, StyleName};
use stickslip_tip::{Model, Noise, Scenario, Start};

const END: f64 = 457.0;
/// x0(t1)
const START: f64 = 14.0;
const NOISE: Noise = Noise { amplitude: 1e-4, spacing: 0.05, seed: 1 };

fn scenario(model: Model) -> Scenario {
    // The support stands at r t1 = 15 + α, and the tip is set down at 14.
    let support = START + 1.0 + model.alpha();
    Scenario {
        start: Start::Flat,
        start_position: support,
        kick: support - START,
        noise: Some(NOISE),
        tolerance: 1e-8,
        ..Scenario::new(model, END)
    }
}

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let tip = beta_1()?;
    let critical = tip.critical(1.0)?.alpha;
    let models = [tip.model(critical - 0.01, 1.0)?, tip.model(critical + 0.01, 1.0)?];
    let mut document =
        figure_with("fig1", "Fig. 1: surface and velocity of the tip, β = 1, r = 1", &models);
    document.remarks = vec![
        "starts as the paper's simulations do: x0(t1) = 14 at t1 = 15 + α on a surface u = 0 but for noise. \
         That is not the steady state, as the paper says: (24) is not 0 under the tip (docs/findings/corrections.md, 13); \
         hence the oscillations at early times"
            .into(),
        "noise of 1e-4 on a grid of 0.05; on the paper's 0.001 its slope alone makes the velocity jitter by \
         0.09 (docs/findings/corrections.md, 10)"
            .into(),
        "t = 457 of the caption; the text says 361 (docs/findings/corrections.md, 12)".into(),
    ];
    let x = spaced(0.0, 470.0, 0.1);
    let headings = ["α = α_c − 0.01", "α = α_c + 0.01"];
    for (model, heading) in models.iter().zip(headings) {
        let scenario = scenario(model.clone());
        let run = finished(&scenario)?;
        let u = heights(&scenario, &run, END, &x)?;
        let mut surface = PanelDocument::new(heading, ("x (σ)", "u(x, t = 457) (kσ²/a)"));
        surface.curves.push(curve(StyleName::Line, "", &x, &u));
        document.panels.push(surface);
        if heading == headings[1] {
            let t = spaced(scenario.start_time(), END, 0.1);
            let velocity: Vec<f64> = t.iter().map(|t| run.trajectory.velocity(*t)).collect();
            let mut panel = PanelDocument::new(heading, ("t (Γ/k)", "ẋ₀ (kσ/Γ)"));
            panel.curves.push(curve(StyleName::Line, "ẋ₀(t)", &t, &velocity));
            let ends = [t[0], END];
            panel.curves.push(curve(StyleName::Dashed, "r", &ends, &[1.0; 2]));
            document.panels.push(panel);
        }
    }
    Ok(document)
}
