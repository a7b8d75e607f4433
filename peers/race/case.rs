//! The one problem that all contestants solve, and what their errors are measured against.

use serde_json::{Value, json};
use stickslip_tip::{Force, MemoryChoice, Model, Pulse, Scenario, TipFunction, Trajectory, run};

/// αc + 0.01 at β = 1, r = 1: just above onset.
pub(crate) const ALPHA: f64 = 1.079_036_174_947;
pub(crate) const R: f64 = 1.0;
pub(crate) const UNTIL: f64 = 457.0;
/// Of the start, steady motion.
pub(crate) const POSITION: f64 = 14.0;
/// An impulse of 0.01 in place of a kick of 0.01: smooth, so that quadrature over fixed lags converges.
/// A kick would cost the delay solvers, whose past it breaks, most of their digits.
pub(crate) const PULSE: Pulse =
    Pulse { amplitude: -0.003_989_422_804_014_327, time: 22.0, width: 1.0 };
/// Error of the reference, checked by another memory.
const TIGHT: f64 = 1e-12;

pub(crate) fn scenario(memory: MemoryChoice, tolerance: f64) -> Scenario {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).expect("a valid tip");
    let model = Model::new(tip, ALPHA, R).expect("a valid model");
    let force = Force::new(vec![PULSE], None).expect("a valid force");
    Scenario { force, memory, tolerance, start_position: POSITION, ..Scenario::new(model, UNTIL) }
}

/// l(t) at times about a half apart.
pub(crate) struct Reference {
    pub(crate) t: Vec<f64>,
    pub(crate) l: Vec<f64>,
    trajectory: Trajectory,
    /// Largest difference of two memories.
    checked_to: f64,
}

impl Reference {
    pub(crate) fn new() -> Self {
        let [direct, other] = [MemoryChoice::Direct, MemoryChoice::Fft]
            .map(|memory| run(&scenario(memory, TIGHT)).expect("a run that ends").trajectory);
        let (start, count) = (direct.start(), 2 * (UNTIL - direct.start()) as u32);
        let at = |i: u32| (start + (UNTIL - start) * f64::from(i) / f64::from(count)).min(UNTIL);
        let t: Vec<f64> = (0..=count).map(at).collect();
        let l: Vec<f64> = t.iter().map(|t| direct.l(*t)).collect();
        let differences = t.iter().zip(&l).map(|(t, l)| (other.l(*t) - l).abs());
        let checked_to = differences.fold(0.0, f64::max);
        Self { t, l, trajectory: direct, checked_to }
    }

    /// l at any time.
    pub(crate) fn l_at(&self, t: f64) -> f64 {
        self.trajectory.l(t)
    }

    /// max |l - reference| over the first times, as many as given.
    pub(crate) fn error(&self, l: impl IntoIterator<Item = f64>) -> f64 {
        self.l.iter().zip(l).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// For the contestants in other languages.
    pub(crate) fn document(&self) -> Value {
        let model = scenario(MemoryChoice::Auto, TIGHT).model;
        json!({
            "case": {
                "tip": "triple Gaussian (48), beta = 1", "alpha": ALPHA, "r": R, "until": UNTIL,
                "start": self.t[0], "start_position": POSITION, "l0": model.steady_l(),
                "pulse": {"amplitude": PULSE.amplitude, "time": PULSE.time, "width": PULSE.width},
            },
            "reference": {
                "made_by": format!("closed equation, direct memory, tolerance {TIGHT:e}"),
                "checked_by": "the same with fft memory", "checked_to": self.checked_to,
                "t": self.t, "l": self.l,
            },
        })
    }
}
