#![cfg_attr(test, allow(clippy::disallowed_methods))]
//! The closed delay equation of a tip that is dragged over a surface and carves it.
//!
//! A spring whose far end moves with velocity r pulls a tip at x0(t). The tip indents a soft surface u(x,t) with its
//! footprint f, and the slope of its own groove pushes it downhill:
//!
//! ```text
//!     x0'(t)  = -u_x(x0(t), t) + r t - x0(t) + Fext(t)            (10)
//!     u_t(x,t) = -α f(x - x0(t))                                  (11)
//! ```
//!
//! The surface depends on the past positions of the tip alone, so that x0(t) obeys a closed equation (18), which this
//! crate integrates: [`run`]. Lengths are in units of the tip width σ, times in units of Γ/k. Equation numbers are
//! those of the paper named in the project's README; `docs/explanation/equation.md` contains the derivations.

pub mod cache;
pub mod collocation;
pub mod elementary;
pub mod error_function;
pub mod exponential;
pub mod friction;
pub mod memory;
pub mod motion;
pub mod planar;
pub mod roots;
pub mod sorting;
pub mod state;
pub mod step;
pub mod stop;
pub mod threads;
pub mod tip_function;
pub mod walker;

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
pub use eigenvalues::{eigenvalues, symmetric_eigen};
pub use footprint::{Across, Footprint, Gaussian2d, Layer};
pub use force::{Force, ForceError, Pulse};
pub use history::{Heights, Moment, Place, STEP_NUMBERS, Step, Trajectory};
pub use initial_surface::InitialSurface;
pub use integrator::{IntegrationError, Integrator, Work};
pub use memory::MemoryChoice;
pub use model::{Model, ModelError};
pub use relief::{Ground, Noise, Relief};
pub use run::{
    MOST_STEPS, Run, RunError, Running, Scenario, Start, TOLERANCES, collect_each, run, run_each,
    run_many, run_observed,
};
pub use series::SeriesError;
pub use support::{Support, SupportPath};
pub use tip_function::{Gaussian, TipFunction, TipFunctionError};
pub use wider::{Wider, WiderError};
