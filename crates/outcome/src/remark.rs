//! Warnings about an outcome.

use std::fmt;

/// A case in which round-off, the initial condition, the tolerance or a disturbance decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remark {
    /// The initial condition is unstable steady motion, without an early disturbance.
    RoundOffGrows {
        /// Rate of growth, in k/Γ.
        rate: f64,
    },
    /// A tip without a spring is at rest by symmetry, and rest is unstable.
    RestsBySymmetry {
        /// Rate of growth at the end, in k/Γ.
        rate: f64,
    },
    /// A tip without a spring was at rest for so long before a force acted that errors have grown beyond the
    /// tolerance.
    ErrorsGrowAtRest {
        /// Growth factor of the errors.
        growth: f64,
    },
    /// Steady motion is stable too, next to the motion that was found.
    SteadyToo,
    /// Oscillations bifurcate below αc: one may be stable next to steady motion.
    OscillationToo,
    /// A trapped tip creeps permanently, next to the motion that was found.
    TrappedToo,
    /// The tip is stuck; the exponentials in its history predict for how long.
    SlipsAfter {
        /// Predicted time, in Γ/k.
        time: f64,
    },
    /// Whether the tip slips again depends on differences below the accuracy of the run.
    AtTheBorder,
    /// The run repeats itself, but differs from the cycle that solves the equation.
    Coarse {
        /// Largest difference of an extremum of l, in σ.
        off: f64,
    },
    /// Steady motion is stable, but it attracts less than the step errors at this tolerance repel.
    TooCoarse,
    /// An external force acts at the end of the run.
    ForceActs,
    /// An external force acts after the end of the run.
    ForceToCome {
        /// Time at which it ends.
        until: f64,
    },
    /// The velocity of the support is not constant.
    OnAPath,
    /// The surface ahead of the tip is not flat.
    UnevenAhead {
        /// Position at which the uneven surface ends, in σ.
        until: f64,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RoundOffGrows { rate } => write!(
                out,
                "the run starts in steady motion, which is unstable, without a disturbance: round-off grows at the \
                 rate {rate:.3} and decides when and how the tip departs; disturb it with --kick D"
            ),
            Self::RestsBySymmetry { rate } => write!(
                out,
                "the tip is at rest, which is unstable (deviations grow at the rate {rate:.3}), and nothing disturbs \
                 it: set it in motion with --pulse A,T,W or, with inertia, --start-velocity"
            ),
            Self::ErrorsGrowAtRest { growth } => write!(
                out,
                "rest is unstable, and errors have grown by a factor of {growth:.1e} before the force was felt: they, \
                 not the force, may decide when and where the tip goes; let the force act earlier, or give a smaller \
                 tolerance"
            ),
            Self::SteadyToo => {
                write!(out, "steady motion is stable here too: the start decides which is reached")
            }
            Self::OscillationToo => write!(
                out,
                "onset is subcritical: a larger disturbance than this may lead to an oscillation"
            ),
            Self::TrappedToo => {
                write!(out, "the tip may also be trapped here: the start decides which is reached")
            }
            Self::SlipsAfter { time } => {
                write!(out, "the tip is stuck, and slips again after about {time:.2e}")
            }
            Self::AtTheBorder => write!(
                out,
                "whether the tip is trapped or slips again depends on less than the accuracy of the run: give a \
                 smaller tolerance or a longer run"
            ),
            Self::Coarse { off } => write!(
                out,
                "the tolerance is coarse for this motion: the run settles {off:.1e} away from the periodic solution \
                 of the equation"
            ),
            Self::TooCoarse => write!(
                out,
                "so close to onset steady motion, though stable, attracts the tip less than the errors of the steps \
                 disturb it: the remaining oscillation is numerical; give a smaller tolerance"
            ),
            Self::ForceActs => write!(out, "the external force still acts at the end of the run"),
            Self::ForceToCome { until } => write!(
                out,
                "an external force acts after the end of the run, until t = {until:?}: it is not taken into account"
            ),
            Self::OnAPath => write!(
                out,
                "the support moves on a given path: there is no settled motion to classify"
            ),
            Self::UnevenAhead { until } => write!(
                out,
                "the surface ahead of the tip is uneven as far as x = {until:?}: before that no motion repeats itself \
                 exactly"
            ),
        }
    }
}
