//! What a trajectory shows: the maxima and minima of l(t), and the period and amplitude of a motion that
//! repeats itself. What the motion *is*, its regime, is for `stickslip-outcome` to say.

mod extrema;
mod oscillation;

pub use extrema::{Extrema, Extremum, latest_extrema};
pub use oscillation::Oscillation;
