//! The orbit diagram: what l returns to in every oscillation, against α.

use super::parts::{curve, figure as empty, finished, panel, spaced};
use super::tips::beta_1;
use crate::documents::{FigureDocument, StyleName};
use crate::failure::Failure;
use stickslip_tip::{Regime, Scenario, Trajectory};

/// Up to which transients die out, and how long is looked at then.
const SETTLED: f64 = 1500.0;
const SHOWN: f64 = 200.0;
/// Between samples in which maxima are looked for.
const SAMPLE: f64 = 0.02;
/// Beyond, l runs off the picture: at the trapping threshold of 2.0868 the periods diverge.
const LAST: f64 = 1.9;
/// Maxima closer than this are one.
const SAME: f64 = 1e-4;

pub(super) fn figure() -> Result<FigureDocument, Failure> {
    let tip = beta_1()?;
    let critical = tip.critical(1.0)?.alpha;
    let mut alphas = spaced(1.0, LAST, 0.005);
    // Finer where the period doubles and comes back.
    alphas.extend(spaced(1.4775, 1.8025, 0.005));
    alphas.sort_by(f64::total_cmp);
    let (mut at, mut maxima, mut steady) = (vec![], vec![], vec![]);
    for alpha in &alphas {
        let model = tip.model(*alpha, 1.0)?;
        steady.push(model.steady_l());
        let scenario =
            Scenario { kick: 0.2, tolerance: 1e-7, ..Scenario::new(model, SETTLED + SHOWN) };
        let run = finished(&scenario)?;
        // Where steady motion is stable, maxima of round-off are none.
        let is_steady = run.outcome.regime == Regime::Steady;
        let found = if is_steady { vec![] } else { maxima_of(&run.trajectory, SETTLED) };
        at.extend(vec![*alpha; found.len()]);
        maxima.extend(found);
    }
    let title = "Orbit diagram: the maxima of l at late times, β = 1, r = 1";
    let mut document = empty("bifurcation", title, &[tip.model(critical, 1.0)?]);
    document.remarks.push(
        "runs of 1,500 time units and the maxima of the next 200, for each α; one for each α is a period of one \
         slip, two are a doubled period. Next to αc transients last longer than that"
            .into(),
    );
    let mut panel = panel("", ("α", "maxima of l (σ)"));
    panel.curves = vec![
        curve(StyleName::Points, "maxima of l", &at, &maxima),
        curve(StyleName::Dashed, "steady state, l₀ = α f(0)/r", &alphas, &steady),
    ];
    document.panels.push(panel);
    Ok(document)
}

/// The distinct local maxima of l after `from`, each at the top of the parabola through three samples.
fn maxima_of(trajectory: &Trajectory, from: f64) -> Vec<f64> {
    let l: Vec<f64> =
        spaced(from, trajectory.end(), SAMPLE).iter().map(|t| trajectory.l(*t)).collect();
    let top = |w: &[f64]| {
        let (rise, bend) = (w[2] - w[0], w[0] - 2.0 * w[1] + w[2]);
        if bend < 0.0 { w[1] - rise * rise / (8.0 * bend) } else { w[1] }
    };
    let peaks = l.windows(3).filter(|w| w[1] > w[0] && w[1] >= w[2]);
    let mut maxima: Vec<f64> = peaks.map(top).collect();
    maxima.sort_by(f64::total_cmp);
    maxima.dedup_by(|a, b| *a - *b < SAME);
    maxima
}
