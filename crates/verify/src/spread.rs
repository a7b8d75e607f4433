//! Effect of an error of the tip's position on the surface, at each position.

use stickslip_tip::{Model, TipFunction, Trajectory};

/// At each x: ∫|f(x - x0(t'))|dt' and ∫|f'(x - x0(t'))|dt' over a run.
pub(super) struct Spread {
    pub(super) height: Vec<f64>,
    pub(super) slope: Vec<f64>,
}

/// Number of positions over the tip's whole path, and over its end.
const PLACES: usize = 2000;
/// Length of the end of the path, in reaches of the footprint (in widths, if it does not decay).
const REACHES: f64 = 10.0;
const WIDTHS: f64 = 100.0;

/// Positions at which two surfaces are compared, in order.
pub(super) fn places(model: &Model, trajectory: &Trajectory) -> Vec<f64> {
    let margin = model.tip().reach().unwrap_or(WIDTHS);
    let ends = [trajectory.x0(trajectory.start()), trajectory.x0(trajectory.end())];
    let (low, high) = (ends[0].min(ends[1]) - margin, ends[0].max(ends[1]) + margin);
    let here = (ends[1] - REACHES * margin).max(low);
    let evenly = |low: f64, high: f64| {
        (0..PLACES).map(move |i| low + (high - low) * i as f64 / (PLACES - 1) as f64)
    };
    let mut x: Vec<f64> = evenly(low, high).chain(evenly(here, ends[1] + margin)).collect();
    x.sort_by(f64::total_cmp);
    x
}

impl Spread {
    /// The integrals of a run, at positions in order.
    pub(super) fn of(tip: &TipFunction, trajectory: &Trajectory, x: &[f64]) -> Self {
        let reach = tip.reach().unwrap_or(f64::INFINITY);
        let mut spread = Self { height: vec![0.0; x.len()], slope: vec![0.0; x.len()] };
        let (positions, weights) = trajectory.residence(trajectory.end());
        for (position, weight) in positions.into_iter().zip(weights) {
            let first = x.partition_point(|x| *x < position - reach);
            for (i, x) in
                x.iter().enumerate().skip(first).take_while(|(_, x)| **x <= position + reach)
            {
                spread.height[i] += weight * tip.value(x - position).abs();
                spread.slope[i] += weight * tip.slope(x - position).abs();
            }
        }
        spread
    }
}
