//! Classification of a motion into regimes, with error estimates.
//!
//! An [`Observer`] collects the maxima and minima of l and the steps at the end of a run. Theory classifies the motion
//! where it applies. The roots of the characteristic equation decide whether steady motion is stable. A limit cycle and
//! its Floquet multipliers give the distance of an oscillation from the cycle, and the rate of approach. The exponentials
//! in the history of a stuck tip decide whether it will slip again. Elsewhere (J0 has no cycles) the changes from period
//! to period are extrapolated. `docs/explanation/regimes.md` derives the criteria.

mod ahead;
mod creep;
mod judge;
mod linear;
mod merged;
mod motion;
mod observer;
mod oscillation;
mod reference;
mod remark;
mod rest;
mod sequence;
mod snaking;
mod tail;
mod thinned;
mod watched;
mod watched_across;

pub use creep::Creeping;
pub use judge::judge;
pub use motion::{Motion, motion};
pub use observer::Observer;
pub use oscillation::Oscillation;
pub use remark::Remark;
pub use snaking::{Snaking, SnakingObserver, snaking};
pub use watched::{Classified, Watched, judge_trajectory, run_and_judge};
pub use watched_across::WatchedAcross;

/// The kinds of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// l stays at l0; without a spring, the tip stays at rest.
    Steady,
    /// A periodic motion that repeats itself.
    StickSlip,
    /// The tip creeps logarithmically in its own pit and never slips.
    Trapped,
    /// A tip without a spring moves on at a constant velocity.
    Drifting,
    /// None of these yet: a longer run is needed to decide.
    Transient,
}

/// The regime of a run, with its numbers and their errors.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The kind of motion.
    pub regime: Regime,
    /// Present where the regime is [`Regime::StickSlip`].
    pub oscillation: Option<Oscillation>,
    /// Present where the regime is [`Regime::Trapped`].
    pub creep: Option<Creeping>,
    /// Present where the regime is [`Regime::Drifting`].
    pub drifting: Option<Drift>,
    /// Present where the regime is [`Regime::Transient`].
    pub prospect: Option<Prospect>,
    /// Warnings: cases in which round-off, the initial condition, the tolerance or a disturbance decides.
    pub remarks: Vec<Remark>,
}

/// The velocity of a tip without a spring.
///
/// Its error is its distance from the velocity of the steady walk that the run approaches, plus the errors of both. Where
/// this walk cannot be computed: twice the largest change of the velocity in the last fifth of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "DriftDocument"))]
#[cfg_attr(feature = "schema", schemars(description = "The velocity of a tip without a spring."))]
pub struct Drift {
    /// x0' at the end of the run, in kσ/Γ; negative towards smaller x.
    pub velocity: f64,
    /// Error of the velocity, in kσ/Γ; the velocity of the settled motion lies within it.
    pub velocity_error: f64,
}

/// Prediction for a transient.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Prospect {
    /// The regime that the run approaches; `None` if it cannot be predicted.
    pub towards: Option<Regime>,
    /// Further time until `towards` is reached, in Γ/k; `None` if it cannot be predicted.
    pub time: Option<f64>,
}
