//! Properties of a trajectory: the maxima and minima of l(t), and the period and amplitude of a periodic motion.
//! `stickslip-outcome` classifies the motion into regimes.

mod extrema;
mod oscillation;

pub use extrema::{Extrema, Extremum, extrema_within, latest_extrema};
pub use oscillation::{Oscillation, last_period};
