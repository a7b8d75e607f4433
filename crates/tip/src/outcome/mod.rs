//! What became of a run: its regime, and its oscillation where it has settled into one.

mod creep;
mod extrema;
mod oscillation;

pub use oscillation::Oscillation;

use crate::{Model, Trajectory};
pub(crate) use extrema::{Extrema, Extremum};

/// The kinds of motion of section 4 of the design: what the end of the run shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// l stays at l0.
    Steady,
    /// A periodic motion that repeats itself.
    StickSlip,
    /// The tip creeps logarithmically in its own pit and will not come out.
    Trapped,
    /// None of these yet: a longer run will tell.
    Transient,
}

/// Regime and oscillation at the end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The kind of motion.
    pub regime: Regime,
    /// Present where the regime is [`Regime::StickSlip`].
    pub oscillation: Option<Oscillation>,
}

/// The last fifth of a run must be steady for the run to count as steady.
const STEADY_SHARE: f64 = 0.2;
/// l within this distance of l0, or a hundred tolerances, is steady.
const STEADY_WITHIN: f64 = 1e-6;

/// Looks at the end of a trajectory.
#[must_use]
pub fn classify(trajectory: &Trajectory, model: &Model, tolerance: f64) -> Outcome {
    let regime = |regime| Outcome { regime, oscillation: None };
    if is_steady(trajectory, model, tolerance) {
        return regime(Regime::Steady);
    }
    let extrema = Extrema::at_the_end_of(trajectory);
    if creep::is_trapped(trajectory, model, &extrema) {
        return regime(Regime::Trapped);
    }
    match Oscillation::of(trajectory, &extrema) {
        Some(oscillation) => Outcome { regime: Regime::StickSlip, oscillation: Some(oscillation) },
        None => regime(Regime::Transient),
    }
}

fn is_steady(trajectory: &Trajectory, model: &Model, tolerance: f64) -> bool {
    let l0 = model.steady_l();
    let within = STEADY_WITHIN.max(100.0 * tolerance);
    let from = trajectory.end() - STEADY_SHARE * (trajectory.end() - trajectory.start());
    let last = trajectory.steps().iter().rev().take_while(|step| step.t >= from);
    let far = |t: f64| (trajectory.l(t) - l0).abs() > within;
    !far(trajectory.end()) && !last.flat_map(|step| [step.t, step.t + 0.5 * step.h]).any(far)
}
