//! The delay solver of the crate differential-equations on (18): the memory integral by Gauss-Legendre
//! lags, cut where F has faded.

use crate::case::{ALPHA, PULSE, R, Reference, scenario};
use crate::{row, timed};
use differential_equations::dde::DDE;
use differential_equations::ivp::IVP;
use differential_equations::methods::ExplicitRungeKutta;
use gauss_quad::legendre::GaussLegendre;
use serde_json::Value;
use std::num::NonZeroUsize;
use stickslip_tip::MemoryChoice;

/// Lags beyond are over 10.6 widths away: F < 1e-15 there.
const CUT: f64 = 11.0;
/// (18) with the pulse, by L lags.
struct Closed<const L: usize> {
    lags: [f64; L],
    weights: [f64; L],
}

impl<const L: usize> Closed<L> {
    fn new() -> Self {
        let rule = GaussLegendre::new(NonZeroUsize::new(L).expect("not zero"));
        let (mut lags, mut weights) = ([0.0; L], [0.0; L]);
        for (i, (node, weight)) in rule.as_node_weight_pairs().iter().enumerate() {
            (lags[i], weights[i]) = (0.5 * CUT * (1.0 + node), 0.5 * CUT * weight);
        }
        Self { lags, weights }
    }
}

/// f'(x) of (48), β = 1, the exponentials of the side lobes from that of the middle.
fn slope(x: f64) -> f64 {
    let (up, down) = ((2.0 * x - 2.0).exp(), (-2.0 * x - 2.0).exp());
    (-0.5 * x * x).exp() * (-x + 0.5 * ((x - 2.0) * up + (x + 2.0) * down))
}

impl<const L: usize> DDE<L, f64, f64> for Closed<L> {
    fn diff(&self, t: f64, l: &f64, past: &[f64; L], rate: &mut f64) {
        let lags = self.lags.iter().zip(&self.weights).zip(past);
        let memory: f64 = lags.map(|((lag, w), then)| w * slope(R * lag + then - l)).sum();
        let z = (t - PULSE.time) / PULSE.width;
        *rate = -ALPHA * memory - l - PULSE.amplitude * (-0.5 * z * z).exp();
    }

    fn lags(&self, _t: f64, _l: &f64, lags: &mut [f64; L]) {
        *lags = self.lags;
    }
}

/// Its history is interpolated by cubics whatever the method, so the length of the steps rules the error,
/// and a high order buys nothing: tried, rkv655e and dop853 at the same lengths err as much or more and take
/// longer. A step is therefore as long as `longest`, the tolerance hardly ever felt.
fn race<const L: usize>(reference: &Reference, longest: f64) -> Option<Value> {
    const TOLERANCE: f64 = 1e-4;
    let scenario = scenario(MemoryChoice::Auto, 1e-9);
    let (start, until, l0) = (scenario.start_time(), scenario.until, scenario.model.steady_l());
    let equation = Closed::<L>::new();
    let setting = format!("dopri5, steps of {longest}, {L} Gauss lags to {CUT}");
    let (solution, seconds) = timed(|| {
        let method = ExplicitRungeKutta::dopri5()
            .rtol(TOLERANCE)
            .atol(TOLERANCE)
            .h_max(longest)
            .max_steps(usize::MAX)
            .max_delay(CUT);
        let problem = IVP::dde(&equation, start, until, l0, |_| l0);
        problem.t_eval(reference.t.clone()).method(method).solve()
    });
    match solution {
        Ok(solution) if solution.y.len() == reference.t.len() => {
            let error = reference.error(solution.y);
            let remark = "rkv655e and dop853 were tried, and err as much or more in a longer time";
            Some(row("differential-equations", setting, seconds, Some(error), remark))
        }
        other => {
            eprintln!("differential-equations, {setting}: {:?}", other.map(|s| s.y.len()));
            None
        }
    }
}

pub(crate) fn rows(reference: &Reference) -> Vec<Value> {
    [
        race::<16>(reference, 0.4),
        race::<16>(reference, 0.3),
        race::<20>(reference, 0.2),
        race::<20>(reference, 0.14),
        race::<24>(reference, 0.1),
        race::<28>(reference, 0.05),
        race::<28>(reference, 0.025),
    ]
    .into_iter()
    .flatten()
    .collect()
}
