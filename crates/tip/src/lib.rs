#![cfg_attr(test, allow(clippy::disallowed_methods))]
//! The closed delay equation of a tip that carves the surface it is dragged over.
//!
//! A tip at x0(t), pulled by a spring whose far end moves with velocity r, indents a soft surface
//! u(x,t) with its footprint f and is pushed down the slope that it left there itself:
//!
//! ```text
//!     x0'(t)  = -u_x(x0(t), t) + r t - x0(t) + Fext(t)            (10)
//!     u_t(x,t) = -α f(x - x0(t))                                  (11)
//! ```
//!
//! All that the surface does to the tip is a memory of the tip's own past, so x0(t) alone obeys a
//! closed equation (18), which this crate integrates: [`run`]. Lengths are in units of the tip width
//! σ, times in units of Γ/k. Equation numbers are those of the paper named in the project's README;
//! `docs/mathematics.md` derives them again.

pub mod collocation;
pub mod elementary;
pub mod exponential;
pub mod friction;
pub mod memory;
pub mod motion;
pub mod planar;
pub mod roots;
pub mod state;
pub mod step;
pub mod stop;
pub mod tip_function;

mod eigenvalues;
mod footprint;
mod force;
mod history;
mod initial_surface;
mod integrator;
mod lambert;
mod model;
mod relief;
mod run;
mod series;
mod spline;
mod support;
mod wider;

pub use collocation::{STAGES, Stages, nodes_and_weights};
pub use eigenvalues::eigenvalues;
pub use footprint::{Across, Footprint, Gaussian2d, Layer};
pub use force::{Force, ForceError, Pulse};
pub use history::{Heights, STEP_NUMBERS, Step, Trajectory};
pub use initial_surface::InitialSurface;
pub use integrator::{IntegrationError, Integrator, Work};
pub use memory::MemoryChoice;
pub use model::{Model, ModelError};
pub use relief::{Noise, Relief};
pub use run::{
    MOST_STEPS, Run, RunError, Running, Scenario, Start, TOLERANCES, run, run_each, run_many,
    run_observed,
};
pub use series::SeriesError;
pub use support::{Support, SupportPath};
pub use tip_function::{Gaussian, TipFunction, TipFunctionError};
pub use wider::{Wider, WiderError};
