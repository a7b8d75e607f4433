//! Walkers: particles in the plane, driven by the field of J0 that they leave.
//!
//! ```text
//!     M x'' + x' = α ∇Q(x,t) - Ω ẑ × x' - K x + F(t)
//!     Q(x,t) = ∫ J0(|x - x(t')|) e^{-(t-t')/T} dt'
//! ```
//!
//! with α < 0: the particle raises the surface and slides down the slope of what it has left. Walking droplets are of
//! this class (A. U. Oza, R. R. Rosales, J. W. M. Bush, J. Fluid Mech. 737 (2013) 552); in a frame that rotates, Ω is the
//! coefficient of their Coriolis force. J0 is a mean over directions of plane waves, so that the field consists of one
//! complex number for each direction ([`directions`]), which obeys an ordinary differential equation (`chain`). The cost
//! of a step does not depend on the length of the history.

mod chain;
mod directions;
mod run;
mod scenario;
mod trajectory;

pub use directions::directions;
pub use run::{WalkerRun, run, run_observed};
pub use scenario::{WalkerError, WalkerPast, WalkerScenario};
pub use trajectory::{WalkerStep, WalkerTrajectory};
