//! The surface u(x,t) after a motion of the tip, from its trajectory alone.
//!
//! ```text
//!     u(x,t) = u0(x) - α ∫_{t1}^t f(x - x0(t'))dt'        (14)
//! ```
//!
//! and in the extended model u0(x) e^{-(t-t1)/T} - α ∫ w(t') e^{-(t-t')/T} f(x - x0(t'))dt', with the indentation rate
//! α w and the healing time T.
//!
//! The integration of the tip does not use the surface; this crate computes it afterwards, at any x and at any t of
//! the run, as a sum over the residence of the tip, the time that it spent at each position. Heights in units of
//! kσ²/a, lengths in σ, times in Γ/k.
//!
//! ```
//! use stickslip_surface::Surface;
//! use stickslip_tip::{Model, Scenario, TipFunction, run};
//!
//! let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0)?, 1.2, 1.0)?;
//! let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 60.0) };
//! let trajectory = run(&scenario)?.trajectory;
//! let initial = scenario.initial_surface()?;
//! let surface = Surface::new(&scenario.model, &initial, &trajectory);
//! let u = surface.heights(60.0, &[20.0, 20.1, 20.2])?;
//! assert!(u.iter().all(|u| u.is_finite()));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod across;
mod carved;
mod image;
mod ripple;

pub use across::{SurfaceAcross, carved_across};
pub use carved::{Method, carved, carved_by};
pub use ripple::{Ripple, ripple_behind};

use ndarray::Array1;
use rayon::prelude::*;
use stickslip_tip::{InitialSurface, Model, Step, Trajectory};
use thiserror::Error;

/// The reason why a surface cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SurfaceError {
    /// A time outside of the run.
    #[error("t = {t} is outside of the run, which lasts from {start} to {end}")]
    OutsideRun {
        /// The time requested.
        t: f64,
        /// Start of the trajectory.
        start: f64,
        /// End of the trajectory.
        end: f64,
    },
    /// A position that is not finite.
    #[error("the position {0} is not a finite number")]
    Position(f64),
}

impl SurfaceError {
    fn check_time<S: AsRef<Step>>(trajectory: &Trajectory<S>, t: f64) -> Result<(), Self> {
        let (start, end) = (trajectory.start(), trajectory.end());
        if (start..=end).contains(&t) { Ok(()) } else { Err(Self::OutsideRun { t, start, end }) }
    }

    fn check_positions<'a>(positions: impl IntoIterator<Item = &'a f64>) -> Result<(), Self> {
        match positions.into_iter().find(|place| !place.is_finite()) {
            Some(place) => Err(Self::Position(*place)),
            None => Ok(()),
        }
    }
}

/// u(x,t) for one run.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    model: &'a Model,
    initial: &'a InitialSurface,
    trajectory: &'a Trajectory,
}

impl<'a> Surface<'a> {
    /// The surface of a tip that moved along `trajectory` over `initial`.
    pub fn new(model: &'a Model, initial: &'a InitialSurface, trajectory: &'a Trajectory) -> Self {
        Self { model, initial, trajectory }
    }

    /// u(x,t), (14), at every x. The accuracy is that of the trajectory; a point costs a bounded number of operations
    /// for any length of the history.
    ///
    /// # Errors
    /// `t` is outside of the run; x is not finite.
    pub fn heights(&self, t: f64, x: &[f64]) -> Result<Array1<f64>, SurfaceError> {
        SurfaceError::check_time(self.trajectory, t)?;
        let mut u = self.far_behind(t, x)?;
        let left = self.trajectory.wider().left_after(t - self.trajectory.start());
        let before = |(u, x): (&mut f64, &f64)| *u += left * self.initial.height(*x);
        u.as_slice_mut().unwrap_or_default().par_iter_mut().zip(x).for_each(before);
        Ok(u)
    }

    /// -α ∫_{t1}^t f(x - x0(t'))dt': the groove carved by time t. Far behind the tip it is the height u∞(x) of (35),
    /// for a run that started far before x.
    ///
    /// # Errors
    /// x is not finite.
    pub fn far_behind(&self, t: f64, x: &[f64]) -> Result<Array1<f64>, SurfaceError> {
        SurfaceError::check_positions(x)?;
        let (positions, weights) = self.trajectory.residence(t);
        let sums = carved(self.model.tip(), &positions, &weights, x);
        Ok(sums.mapv_into(|sum| -self.model.alpha() * sum))
    }
}
