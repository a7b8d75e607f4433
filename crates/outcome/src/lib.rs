//! What became of a run: its regime, and its oscillation where it has settled into one.

mod classifier;
mod creep;
mod motion;
mod thinned;
mod watched;

pub use classifier::Classifier;
pub use motion::{Motion, motion};
pub use watched::{Watched, run_and_judge};

use stickslip_tip::motion::Oscillation;
use stickslip_tip::{Model, Trajectory};

/// The kinds of motion: what the end of the run shows.
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

/// Looks at the end of a trajectory.
#[must_use]
pub fn classify(trajectory: &Trajectory, model: &Model, tolerance: f64) -> Outcome {
    let mut classifier = Classifier::new(model, tolerance);
    trajectory.steps().iter().for_each(|step| classifier.observe(step));
    classifier.outcome(model)
}

/// The README's example is compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
