//! The full PDE on our three grids.

use crate::case::{ALPHA, POSITION, PULSE, R, Reference, UNTIL};
use crate::{row, timed};
use serde_json::Value;
use std::ops::ControlFlow;
use stickslip_grid::{
    Footprint, Gaussian, Method, Problem, Request, Start, Stepping, solve_observed,
};

fn triple_gaussian(x: f64) -> f64 {
    let bell = |x: f64| (-0.5 * x * x).exp();
    bell(x) - 0.5 * (bell(x + 2.0) + bell(x - 2.0))
}

/// Steps as long as in the paper.
const PAPER_STEP: f64 = 0.04;

/// Runs to `end`; the largest error of l at the ends of the grid's own steps.
fn run(reference: &Reference, method: &Method, stepping: &Stepping, end: f64) -> f64 {
    let footprint = Footprint::new(&triple_gaussian, 10.8).expect("a valid reach");
    let start = Start::steady(ALPHA, R, footprint, POSITION, 0.0);
    let force = |t: f64| {
        let z = (t - PULSE.time) / PULSE.width;
        PULSE.amplitude * (-0.5 * z * z).exp()
    };
    let problem = Problem::new(ALPHA, R, footprint, start).expect("a valid problem");
    let request = Request { times: &[end], points: &[] };
    let mut error = 0.0_f64;
    let watch = &mut |t: f64, x0: f64| {
        error = error.max((R * t - R - x0 - reference.l_at(t)).abs());
        ControlFlow::Continue(())
    };
    solve_observed(&problem.with_force(&force), method, stepping, &request, watch)
        .expect("a run that ends");
    error
}

pub(crate) fn rows(reference: &Reference) -> Vec<Value> {
    let span = UNTIL - reference.t[0];
    let mut rows = vec![];
    let paper = Stepping { max_step: PAPER_STEP, ..Stepping::ode45() };
    for spacing in [0.001, 0.0018, 0.01] {
        let windowed = Method::Windowed { spacing };
        let (error, seconds) = timed(|| run(reference, &windowed, &paper, UNTIL));
        let setting = format!("dx {spacing}, dopri5, dt {PAPER_STEP}");
        rows.push(row("grid (b), windowed", setting.clone(), seconds, Some(error), ""));
        let uniform = Method::Uniform { spacing, from: 0.0, to: 471.0 };
        let short = 20.0 * PAPER_STEP;
        let end = reference.t[0] + short;
        let (_, seconds) = timed(|| run(reference, &uniform, &paper, end));
        let remark = "time extrapolated from 20 steps; error that of (b), the same scheme";
        rows.push(row("grid (a), uniform", setting, seconds * span / short, Some(error), remark));
    }
    let term = |amplitude, center| Gaussian { amplitude, center, width: 1.0 };
    let gaussians = vec![term(1.0, 0.0), term(-0.5, 2.0), term(-0.5, -2.0)];
    for (spacing, digits) in
        [(0.6, 4), (0.5, 5), (0.5, 6), (0.46, 7), (0.43, 8), (0.4, 9), (0.38, 10), (0.36, 11)]
    {
        let method = Method::Spectral { gaussians: gaussians.clone(), spacing };
        let stepping = Stepping::absolute(10.0_f64.powi(-digits));
        let (error, seconds) = timed(|| run(reference, &method, &stepping, UNTIL));
        let setting = format!("spacing {spacing}, dop853, tolerance 1e-{digits}");
        rows.push(row("grid (c), spectral", setting, seconds, Some(error), ""));
    }
    rows
}
