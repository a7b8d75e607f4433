//! Errors of the grid solvers.

use thiserror::Error;

/// An invalid input, or a run that cannot continue.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum GridError {
    /// α must be finite and ≥ 0.
    #[error("alpha is {0}: the indentation rate must be a finite number ≥ 0")]
    Alpha(f64),
    /// r must be finite and > 0.
    #[error("r is {0}: the support velocity must be a finite number > 0")]
    R(f64),
    /// κ_y must be finite and ≥ 0.
    #[error("the stiffness across is {0}: it must be a finite number ≥ 0")]
    StiffnessAcross(f64),
    /// A depth limit, a healing time or an inertia must be finite and > 0.
    #[error("{0}: a depth limit, healing time or inertia must be a finite number > 0")]
    Wider(f64),
    /// The reach of the footprint must be finite and > 0.
    #[error("the footprint's reach is {0}: it must be a finite number > 0")]
    Reach(f64),
    /// Time and position of the start must be finite.
    #[error("the start is t = {time}, x0 = {x0}: both must be finite")]
    Start {
        /// Start time t1.
        time: f64,
        /// x0(t1)
        x0: f64,
    },
    /// The spacing must be finite and > 0.
    #[error("the grid spacing is {0}: it must be a finite number > 0")]
    Spacing(f64),
    /// Too few or too many cells lie between the two ends.
    #[error(
        "the grid runs from {from} to {to}: it must contain at least four cells and at most 2^31"
    )]
    Domain {
        /// Left end
        from: f64,
        /// Right end
        to: f64,
    },
    /// The grid of a raster has too few or too many cells.
    #[error("the grid has {0:.3e} cells: it must have at least four and at most 1e8")]
    Cells(f64),
    /// Tolerances must be ≥ 0 and not both 0, steps > 0.
    #[error("unusable stepping: tolerances must be ≥ 0 and not both 0, steps > 0")]
    Stepping,
    /// Requested times must be finite, ascending, at or after the start.
    #[error("requested time {0}: times must be finite, ascending and not before the start")]
    Time(f64),
    /// A Gaussian needs finite amplitude and center, and a width > 0; there must be at least one Gaussian.
    #[error("a lattice of Gaussians needs at least one, with finite numbers and width > 0")]
    Gaussians,
    /// The interpolation must reach over 1 to 10000 cells.
    #[error("the interpolation reaches over {0} cells: it must be between 1 and 10000")]
    HalfWidth(usize),
    /// Reading after writing does not reproduce the footprint.
    #[error(
        "the lattice reproduces the footprint only to {defect:e}: refine its spacing, or give it the Gaussians of that very footprint"
    )]
    Defect {
        /// Largest |Σ read · write - f|
        defect: f64,
    },
    /// The tip left the grid.
    #[error("the tip left the grid at t = {time}, x0 = {x0}: extend the grid")]
    LeftGrid {
        /// Time t.
        time: f64,
        /// x0(t)
        x0: f64,
    },
    /// No step is small enough: the motion is not finite, or too stiff for an explicit method.
    #[error("the step size fell to {step:.1e} at t = {time}: loosen the tolerance")]
    StepTooSmall {
        /// Time t.
        time: f64,
        /// The last step tried
        step: f64,
    },
    /// The observer stopped the run.
    #[error("cancelled at t = {time}")]
    Stopped {
        /// Time t.
        time: f64,
    },
}
