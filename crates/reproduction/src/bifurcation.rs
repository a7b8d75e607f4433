//! The bifurcation diagram: the branches of cycles with their period doublings, and the settled motion of runs.

use super::parts::{Failed, curve, failed, figure as empty, finished, spaced};
use super::tips::{Tip, beta_1};
use std::ops::ControlFlow;
use stickslip::{FigureDocument, PanelDocument, StyleName};
use stickslip_cycles::{Branch, Continuation, Cycle, SpecialKind};
use stickslip_outcome::{Regime, judge_trajectory};
use stickslip_tip::{Scenario, Trajectory};

/// Time after which transients have decayed, and duration of the evaluation.
const SETTLED: f64 = 1500.0;
const SHOWN: f64 = 200.0;
/// Sampling interval for the search of maxima.
const SAMPLE: f64 = 0.02;
/// Maxima at a smaller distance count as one.
const SAME: f64 = 1e-4;
/// Largest α: beyond it, l leaves the picture; at the trapping threshold of 2.0868 the periods diverge.
const LAST: f64 = 1.9;
const FIRST: f64 = 1.0;

pub(super) fn figure() -> Result<FigureDocument, Failed> {
    let tip = beta_1()?;
    let (main, doubled) = branches(&tip)?;
    let runs = Runs::settled(&tip)?;
    let critical = tip.critical(1.0)?.alpha;
    let title = "Bifurcation diagram, β = 1, r = 1";
    let mut document = empty("bifurcation", title, &[tip.model(critical, 1.0)?]);
    document.remarks = vec![
        "lines: cycles continued in α from onset, and from the period doubling on; points: runs of 1,700 time \
         units. Next to a bifurcation transients last longer than that"
            .into(),
    ];
    document.panels = vec![amplitudes(critical, &main, doubled.as_ref(), &runs), maxima(&runs)];
    Ok(document)
}

/// The branch from onset, and that from its first period doubling.
fn branches(tip: &Tip) -> Result<(Branch, Option<Branch>), Failed> {
    let settings = Continuation { to: LAST, longest_step: 0.02, ..Continuation::default() };
    let go_on = |_: &Cycle| ControlFlow::Continue(());
    let main = settings.from_onset(&tip.function, 1.0, go_on);
    let main = main.map_err(failed("the branch of cycles"))?;
    let doubling = main.special.iter().find(|s| s.kind == SpecialKind::PeriodDoubling);
    let doubled = doubling.map(|special| settings.switched(special, go_on)).transpose();
    let doubled = doubled.map_err(failed("the doubled branch"))?;
    Ok((main, doubled))
}

fn amplitudes(
    critical: f64,
    main: &Branch,
    doubled: Option<&Branch>,
    runs: &Runs,
) -> PanelDocument {
    let mut panel = PanelDocument::new("", ("α", "amplitude of x₀ (σ)"));
    // Steady motion is the branch of amplitude 0.
    panel.curves = vec![
        curve(StyleName::Line, "stable", &[FIRST, critical], &[0.0; 2]),
        curve(StyleName::Dashed, "unstable", &[critical, LAST], &[0.0; 2]),
    ];
    for branch in std::iter::once(main).chain(doubled) {
        let stretches: Vec<_> = branch.points.chunk_by(|a, b| a.stable == b.stable).collect();
        for (i, stretch) in stretches.iter().enumerate() {
            let style = if stretch[0].stable { StyleName::Line } else { StyleName::Dashed };
            // Up to where the next one begins: no gap is left.
            let next = stretches.get(i + 1).and_then(|next| next.first());
            let (x, y): (Vec<f64>, Vec<f64>) =
                stretch.iter().chain(next).map(|p| (p.alpha, p.amplitude_x0)).unzip();
            let mut line = curve(style, "", &x, &y);
            line.smooth = true;
            panel.curves.push(line);
        }
    }
    let (x, y): (Vec<f64>, Vec<f64>) = main
        .special
        .iter()
        .filter(|s| s.kind == SpecialKind::PeriodDoubling)
        .filter_map(|s| s.cycle.as_ref().map(|cycle| (s.alpha, cycle.amplitude_x0())))
        .unzip();
    panel.curves.push(curve(StyleName::OpenTriangles, "period doubling", &x, &y));
    panel.curves.push(curve(StyleName::Points, "runs", &runs.alpha, &runs.amplitude));
    panel
}

fn maxima(runs: &Runs) -> PanelDocument {
    let mut panel = PanelDocument::new("", ("α", "maxima of l (σ)"));
    let (alpha, steady): (Vec<f64>, Vec<f64>) = runs.steady.iter().copied().unzip();
    panel.curves = vec![
        curve(StyleName::Points, "maxima of l in runs", &runs.alpha_of_maxima, &runs.maxima),
        curve(StyleName::Dashed, "steady state, l₀ = α f(0)/r", &alpha, &steady),
    ];
    panel
}

/// The settled motion of runs.
#[derive(Debug, Default)]
struct Runs {
    alpha: Vec<f64>,
    amplitude: Vec<f64>,
    alpha_of_maxima: Vec<f64>,
    maxima: Vec<f64>,
    /// α and l0.
    steady: Vec<(f64, f64)>,
}

impl Runs {
    fn settled(tip: &Tip) -> Result<Self, Failed> {
        let mut runs = Self::default();
        for alpha in spaced(FIRST, LAST, 0.01) {
            let model = tip.model(alpha, 1.0)?;
            runs.steady.push((alpha, model.steady_l()));
            let scenario =
                Scenario { kick: 0.2, tolerance: 1e-7, ..Scenario::new(model, SETTLED + SHOWN) };
            let run = finished(&scenario)?;
            let outcome = judge_trajectory(&scenario, &run.initial_surface, &run.trajectory);
            if let Some(oscillation) = outcome.oscillation {
                runs.alpha.push(alpha);
                runs.amplitude.push(oscillation.amplitude_x0);
            }
            // Where steady motion is stable, maxima of round-off are none.
            if outcome.regime != Regime::Steady {
                let maxima = maxima_of(&run.trajectory, SETTLED);
                runs.alpha_of_maxima.extend(vec![alpha; maxima.len()]);
                runs.maxima.extend(maxima);
            }
        }
        Ok(runs)
    }
}

/// The distinct local maxima of l after `from`, each at the maximum of the parabola through three samples.
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
